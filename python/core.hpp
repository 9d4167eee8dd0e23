#pragma once

#include <mpi.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "python/arrays.hpp"
#include "quadloop/quadloop.hpp"

/// What the files of the module quadloop._core share.
namespace quadloop::python {

using Released = py::call_guard<py::gil_scoped_release>;

/// A communicator that Python may hold.
struct CoreCommunicator {
  std::shared_ptr<const Communicator> comm;
};

/// `handle` of mpi4py's communicator; none: this process alone. Initialises MPI if nobody has done it.
std::shared_ptr<const Communicator> communicator_of(std::optional<MPI_Fint> handle);
/// Finalises MPI if communicator_of() initialised it.
void finish_communicators();

/// Adds the class Communicator to the module.
void add_communicator(py::module_& module);

/// A case on a communicator.
struct CoreCase {
  std::shared_ptr<const Communicator> comm;
  std::optional<Case> of;
};

/// A mesh that Python may hold as long as it likes. Its arrays are views.
struct CoreMesh {
  std::shared_ptr<const Communicator> comm;
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const SolvedMesh> solved;  ///< with its tree; null for a mesh from a file
  LayerReport layers;
  std::optional<Case> of;
};

CoreMesh core_mesh(const std::shared_ptr<const Communicator>& comm, std::shared_ptr<const SolvedMesh> solved,
                   LayerReport layers, const Case& of);

/// The map from a mesh to another one.
struct CoreMap {
  std::shared_ptr<const Communicator> comm;
  std::shared_ptr<const TransferMap> map;
};

/// Reports the stages of calls to a function of Python, which may be None. Signals such as Ctrl-C take effect
/// at each stage.
class StageReports {
 public:
  explicit StageReports(py::object function) : function_{std::move(function)} {}

  /// The object must outlive the callback.
  ProgressCallback callback() {
    return [this](const Progress& progress) { return report(progress); };
  }
  /// Runs work without the interpreter lock. If an error of Python cancelled it on this rank, that is raised.
  template <class Work>
  auto watch(const Work& work) {
    try {
      const py::gil_scoped_release released;
      return work();
    } catch (const Cancelled&) {
      if (raised_) throw py::error_already_set(*std::exchange(raised_, {}));
      throw;
    }
  }

  /// Runs work with the interpreter lock, within watch(). An error of Python cancels the call.
  template <class Work>
  auto call(const Work& work) {
    const py::gil_scoped_acquire acquired;
    try {
      return work();
    } catch (const py::error_already_set& error) {
      raised_.emplace(error);
      const std::string text = error.what();  // with the traceback in further lines
      throw Cancelled(text.substr(0, text.find('\n')));
    }
  }

 private:
  bool report(const Progress& progress);

  py::object function_;
  std::optional<py::error_already_set> raised_;
};

/// Adds the class Adaptation to the module.
void add_adaptation(py::module_& module);

/// Adds the built-in flow solver to the module.
void add_flow(py::module_& module);

}  // namespace quadloop::python
