// The communicators of the module quadloop._core, and the meetings of ranks before collective calls.
#include <mpi.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/mpi_singleton.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"
#include "python/core.hpp"
#include "quadloop/quadloop.hpp"

namespace quadloop::python {

namespace {

/// The communicators that were passed, by their Fortran handle. MPI is initialised with the first one if
/// nobody has done it, and then finalised by finish(). A communicator that its owner frees is forgotten, as
/// another one may get its handle.
class Communicators {
 public:
  std::shared_ptr<const Communicator> of(std::optional<MPI_Fint> handle) {
    initialise();
    std::shared_ptr<const Communicator>& known = known_[handle];
    if (known) return known;
    known = std::make_shared<const Communicator>(handle ? MPI_Comm_f2c(*handle) : MPI_COMM_SELF);
    if (handle) watch(*handle);
    numbers_[known.get()].own = static_cast<std::int64_t>(numbers_.size());
    all_.push_back(known);
    return known;
  }
  /// A number that no other communicator of this process has.
  std::int64_t number(const Communicator& comm) { return numbers_[&comm].own; }
  std::int64_t next_number(const Communicator& comm) { return numbers_[&comm].given++; }
  void finish() {
    int finalised = 0;
    MPI_Finalized(&finalised);
    if (finalised != 0) return;
    known_.clear();
    all_.clear();
    if (initialised_here_) MPI_Finalize();
  }

 private:
  struct Numbers {
    std::int64_t own = 0, given = 0;
  };

  void initialise() {
    int initialised = 0;
    MPI_Initialized(&initialised);
    if (initialised != 0) return;
    const app::MpiSingleton settings;
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    initialised_here_ = true;
  }
  /// An attribute of the communicator tells when it is freed.
  void watch(MPI_Fint handle) {
    if (key_ == MPI_KEYVAL_INVALID)
      MPI_Comm_create_keyval(MPI_COMM_NULL_COPY_FN, &Communicators::forget, &key_, this);
    MPI_Comm_set_attr(MPI_Comm_f2c(handle), key_, nullptr);
  }
  static int forget(MPI_Comm comm, int /*key*/, void* /*value*/, void* self) {
    static_cast<Communicators*>(self)->known_.erase(MPI_Comm_c2f(comm));
    return MPI_SUCCESS;
  }

  std::map<std::optional<MPI_Fint>, std::shared_ptr<const Communicator>> known_;
  std::vector<std::shared_ptr<const Communicator>> all_;  ///< until the end, as meshes may use them
  std::map<const Communicator*, Numbers> numbers_;
  int key_ = MPI_KEYVAL_INVALID;
  bool initialised_here_ = false;
};

Communicators& communicators() {
  static Communicators all;
  return all;
}

/// An error that a rank has met before a collective call.
enum class Failure : std::int32_t {
  none,
  input,          ///< InputError
  other,          ///< any other exception
  of_other_rank,  ///< one that a meeting raised because of another rank
};

/// Where a rank is: at a collective call, whose arguments must be the same on all ranks, or, if it `waits`,
/// at the end of a function of the user.
struct Place {
  std::string call;
  std::vector<std::pair<std::string, std::string>> arguments;  ///< name and value
  bool waits;
};

/// What all ranks learn of each one.
struct Arrival {
  std::uint64_t call, arguments;
  Failure failure;
  std::int32_t waits;
};

Arrival arrival_of(const Place& place, Failure failure) {
  std::string arguments;
  for (const auto& [name, value] : place.arguments) arguments += name + '\0' + value + '\0';
  const std::hash<std::string> hash;
  return {hash(place.call), hash(arguments), failure, place.waits ? 1 : 0};
}

/// Two places as words, call first, that are not the same.
std::string difference_of(const std::vector<std::string>& of_root, const std::vector<std::string>& of_other,
                          int other) {
  const std::string rank = "rank " + std::to_string(other);
  if (of_root.front() != of_other.front())
    return of_other.front() + " on " + rank + ", but " + of_root.front() +
           " on rank 0: all ranks call the same functions in the same order";
  const auto [root, there] = std::mismatch(of_root.begin(), of_root.end(), of_other.begin(), of_other.end());
  const auto name = static_cast<std::size_t>(root - of_root.begin() - 1) / 2 * 2 + 1;
  constexpr std::size_t longest = 60;
  const std::string& value = of_other.at(name + 1);
  const std::string& wanted = of_root.at(name + 1);
  const bool is_short = std::max(value.size(), wanted.size()) <= longest;
  const std::string what = of_root.front() + ": '" + of_root.at(name) + "' ";
  if (is_short) return what + "is " + value + " on " + rank + ", but " + wanted + " on rank 0";
  return what + "on " + rank + " differs from that on rank 0";
}

/// The rank whose error is reported: the lowest with an error of its own, else the lowest with any.
std::optional<int> failed_rank(const std::vector<Arrival>& arrivals) {
  const auto is_own = [](const Arrival& at) {
    return at.failure == Failure::input || at.failure == Failure::other;
  };
  auto found = std::find_if(arrivals.begin(), arrivals.end(), is_own);
  if (found == arrivals.end())
    found = std::find_if(arrivals.begin(), arrivals.end(),
                         [](const Arrival& at) { return at.failure != Failure::none; });
  if (found == arrivals.end()) return std::nullopt;
  return static_cast<int>(found - arrivals.begin());
}

/// The error that ranks without one of their own raise; none if all are at the same place without errors.
/// *Collective.*
std::optional<std::pair<Failure, std::string>> error_of(const Communicator& comm, const Place& place,
                                                        const std::vector<Arrival>& arrivals,
                                                        const std::string& text) {
  if (const std::optional<int> rank = failed_rank(arrivals))
    return std::pair(arrivals[static_cast<std::size_t>(*rank)].failure,
                     broadcast_words(comm, {text}, *rank).front());
  const Arrival& root = arrivals.front();
  const auto other = std::find_if(arrivals.begin(), arrivals.end(), [&](const Arrival& at) {
    return at.call != root.call || at.arguments != root.arguments;
  });
  if (other == arrivals.end()) return std::nullopt;
  std::vector<std::string> words{place.call};
  for (const auto& [name, value] : place.arguments) words.insert(words.end(), {name, value});
  const auto rank = static_cast<int>(other - arrivals.begin());
  const std::vector<std::string> of_root = broadcast_words(comm, words);
  return std::pair(Failure::input, difference_of(of_root, broadcast_words(comm, words, rank), rank));
}

/// Raises a signal that came while this rank waited for the others, and Cancelled on them: afterwards they
/// would wait in the library for a rank that has left. *Collective.*
void check_signals(const Communicator& comm) {
  std::optional<py::error_already_set> raised;
  {
    const py::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() != 0) raised.emplace();
  }
  if (!comm.any(raised.has_value())) return;
  if (raised) throw py::error_already_set(*std::exchange(raised, {}));
  throw Cancelled("KeyboardInterrupt on another rank");
}

/// Returns when all ranks are at the same place without errors. Otherwise all ranks raise the error of one of
/// them, or one that names the difference. A rank that waits at the end of a function of the user does so
/// until the others have left theirs: their collective calls raise an error meanwhile. *Collective*, from
/// different places.
void meet(const CoreCommunicator& self, const Place& place, Failure failure, const std::string& text) {
  const Communicator& comm = *self.comm;
  const Arrival own = arrival_of(place, failure);
  for (;;) {
    const std::vector<Arrival> arrivals = comm.all_gather(own);
    const auto error = error_of(comm, place, arrivals, text);
    if (!error) return check_signals(comm);
    const bool others_call =
        std::any_of(arrivals.begin(), arrivals.end(), [](const Arrival& at) { return at.waits == 0; });
    if (place.waits && others_call) continue;
    if (error->first == Failure::input) throw InputError(error->second);
    throw SolverError(error->second);
  }
}

}  // namespace

std::shared_ptr<const Communicator> communicator_of(std::optional<MPI_Fint> handle) {
  return communicators().of(handle);
}

void finish_communicators() { communicators().finish(); }

void add_communicator(py::module_& module) {
  py::enum_<Failure>(module, "Failure")
      .value("none", Failure::none)
      .value("input", Failure::input)
      .value("other", Failure::other)
      .value("of_other_rank", Failure::of_other_rank);
  py::class_<CoreCommunicator>(module, "Communicator")
      .def(py::init([](std::optional<MPI_Fint> handle) { return CoreCommunicator{communicator_of(handle)}; }))
      .def_property_readonly("rank", [](const CoreCommunicator& self) { return self.comm->rank(); })
      .def_property_readonly("size", [](const CoreCommunicator& self) { return self.comm->size(); })
      .def_property_readonly("number",
                             [](const CoreCommunicator& self) { return communicators().number(*self.comm); })
      .def("is_same", [](const CoreCommunicator& self,
                         const CoreCommunicator& other) { return self.comm == other.comm; })
      .def("next_number",
           [](const CoreCommunicator& self) { return communicators().next_number(*self.comm); })
      .def(
          "maximum", [](const CoreCommunicator& self, double value) { return self.comm->maximum(value); },
          Released())
      .def(
          "sum",
          [](const CoreCommunicator& self, double value) {
            return reproducible_sum(*self.comm, std::array<double, 1>{value});
          },
          Released())
      .def(
          "meet",
          [](const CoreCommunicator& self, const std::string& call,
             const std::vector<std::pair<std::string, std::string>>& arguments, bool waits, Failure failure,
             const std::string& text) {
            meet(self, {call, arguments, waits}, failure, text);
          },
          Released());
}

}  // namespace quadloop::python
