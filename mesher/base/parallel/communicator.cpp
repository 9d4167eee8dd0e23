#include "mesher/base/parallel/communicator.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <string>
#include <thread>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/base/parallel/free_memory.hpp"

namespace quadloop {

namespace {

constexpr auto shortest_nap = std::chrono::microseconds(100), longest_nap = std::chrono::microseconds(10000);
constexpr std::size_t largest_message = Communicator::largest_message;

template <class T>
T reduced(T value, MPI_Datatype type, MPI_Op operation, MPI_Comm comm) {
  T result{};
  MPI_Allreduce(&value, &result, 1, type, operation, comm);
  return result;
}

/// Calls `visit(begin, length)` for the pieces of a message.
template <class Visit>
void for_pieces(std::size_t size, std::size_t largest, const Visit& visit) {
  for (std::size_t begin = 0; begin < size; begin += largest)
    visit(begin, static_cast<int>(std::min(largest, size - begin)));
}

/// Fault rather than truncation: callers limit the size of collective messages.
int count_of(std::size_t size) {
  QUADLOOP_REQUIRE(size <= largest_message, "a collective message of more than 1 GiB", size);
  return static_cast<int>(size);
}

std::vector<int> offsets_of(const std::vector<int>& counts) {
  std::vector<int> offsets(counts.size() + 1, 0);
  for (std::size_t r = 0; r < counts.size(); ++r) {
    offsets[r + 1] = count_of(static_cast<std::size_t>(offsets[r]) + static_cast<std::size_t>(counts[r]));
  }
  return offsets;
}

/// Receives one count, if there is one.
void receive_count(MPI_Comm comm, int tag, std::vector<Communicator::Count>& counts) {
  int is_there = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, tag, comm, &is_there, &status);
  if (is_there == 0) return;
  Communicator::Count& count = counts.emplace_back(Communicator::Count{status.MPI_SOURCE, 0});
  MPI_Recv(&count.count, 1, MPI_INT64_T, count.rank, tag, comm, MPI_STATUS_IGNORE);
}

bool has_ended(std::span<MPI_Request> requests) {
  int all = 0;
  MPI_Testall(size32(requests), requests.data(), &all, MPI_STATUSES_IGNORE);
  return all != 0;
}

MPI_Comm duplicate_of(MPI_Comm comm) {
  MPI_Comm duplicate = MPI_COMM_NULL;
  MPI_Comm_dup(comm, &duplicate);
  return duplicate;
}

/// Throws the same type of error on every rank.
[[noreturn]] void rethrow(ExitStatus status, const std::string& message) {
  switch (status) {
    case ExitStatus::bad_input: throw InputError(message);
    case ExitStatus::wrong_usage: throw UsageError(message);
    case ExitStatus::solver_failed: throw SolverError(message);
    case ExitStatus::output_failed: throw OutputError(message);
    case ExitStatus::fault: throw Fault(message);
    case ExitStatus::stopped: throw Stopped(message);
    default: throw Error(status, message);
  }
}

}  // namespace

Communicator::Communicator(MPI_Comm to_duplicate) : Communicator(ToOwn{duplicate_of(to_duplicate)}) {}

Communicator::Communicator(ToOwn to_own) : comm_{to_own.comm} {
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}

Communicator::~Communicator() {
  int finalised = 0;  // as when a garbage collector outlives MPI
  MPI_Finalized(&finalised);
  if (finalised == 0) MPI_Comm_free(&comm_);
}

Communicator Communicator::ranks_with(int number) const {
  ToOwn part;
  MPI_Comm_split(comm_, number, rank_, &part.comm);
  return Communicator(part);
}

Communicator Communicator::ranks_of_node() const {
  ToOwn part;
  MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &part.comm);
  return Communicator(part);
}

std::int64_t Communicator::sum(std::int64_t value) const {
  return reduced(value, MPI_INT64_T, MPI_SUM, comm_);
}
std::vector<std::int64_t> Communicator::sum(std::span<const std::int64_t> values) const {
  std::vector<std::int64_t> sums(values.size());
  for_pieces(values.size(), largest_message / sizeof(std::int64_t), [&](std::size_t begin, int length) {
    MPI_Allreduce(values.data() + begin, sums.data() + begin, length, MPI_INT64_T, MPI_SUM, comm_);
  });
  return sums;
}
std::int64_t Communicator::minimum(std::int64_t value) const {
  return reduced(value, MPI_INT64_T, MPI_MIN, comm_);
}
std::int64_t Communicator::maximum(std::int64_t value) const {
  return reduced(value, MPI_INT64_T, MPI_MAX, comm_);
}
double Communicator::minimum(double value) const { return reduced(value, MPI_DOUBLE, MPI_MIN, comm_); }
double Communicator::maximum(double value) const { return reduced(value, MPI_DOUBLE, MPI_MAX, comm_); }

std::int64_t Communicator::exclusive_sum(std::int64_t value) const {
  std::int64_t before = 0;
  MPI_Exscan(&value, &before, 1, MPI_INT64_T, MPI_SUM, comm_);
  return rank_ == 0 ? 0 : before;
}

void Communicator::barrier() const { MPI_Barrier(comm_); }

void Communicator::patient_barrier() const {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibarrier(comm_, &request);
  auto nap = shortest_nap;
  for (int done = 0; done == 0; nap = std::min(2 * nap, longest_nap)) {
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done == 0) std::this_thread::sleep_for(nap);
  }
}

std::vector<std::byte> Communicator::all_gather_bytes(std::span<const std::byte> bytes) const {
  const int mine = count_of(bytes.size());
  std::vector<int> counts(size_);
  MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
  const std::vector<int> offsets = offsets_of(counts);
  std::vector<std::byte> all(offsets.back());
  MPI_Allgatherv(bytes.data(), mine, MPI_BYTE, all.data(), counts.data(), offsets.data(), MPI_BYTE, comm_);
  return all;
}

std::size_t Communicator::broadcast_size(std::size_t size, int from) const {
  std::uint64_t agreed = size;
  MPI_Bcast(&agreed, 1, MPI_UINT64_T, from, comm_);
  return agreed;
}

void Communicator::broadcast_bytes(std::span<std::byte> bytes, int from, std::size_t largest_piece) const {
  for_pieces(bytes.size(), largest_piece, [&](std::size_t begin, int length) {
    MPI_Bcast(bytes.data() + begin, length, MPI_BYTE, from, comm_);
  });
}

std::vector<Communicator::Count> Communicator::exchange_counts(std::span<const Count> to, int many) const {
  if (size_ >= many) return counts_by_consensus(to);
  const auto size = static_cast<std::size_t>(size_);
  std::vector<std::int64_t> to_rank(size, 0), from_rank(size, 0);
  for (const Count& message : to) to_rank[static_cast<std::size_t>(message.rank)] = message.count;
  MPI_Alltoall(to_rank.data(), 1, MPI_INT64_T, from_rank.data(), 1, MPI_INT64_T, comm_);
  std::vector<Count> from;
  for (int rank = 0; rank < size_; ++rank) {
    if (const std::int64_t count = from_rank[static_cast<std::size_t>(rank)]; count != 0)
      from.push_back({rank, count});
  }
  return from;
}

std::vector<Communicator::Count> Communicator::counts_by_consensus(std::span<const Count> to) const {
  // A rank may begin the next exchange while others still wait in this one, but not the one after that.
  const int tag = exchanges_++ % 2 == 0 ? 4 : 5;
  std::vector<Count> from;
  std::vector<MPI_Request> sent;
  for (const Count& message : to) {
    if (message.rank == rank_)
      from.push_back(message);
    else
      MPI_Issend(&message.count, 1, MPI_INT64_T, message.rank, tag, comm_, &sent.emplace_back());
  }
  // A rank whose messages have all been received enters the barrier; behind it no message is under way.
  MPI_Request barrier = MPI_REQUEST_NULL;
  for (bool is_waiting = false, done = false; !done;) {
    receive_count(comm_, tag, from);
    if (is_waiting) {
      done = has_ended(std::span(&barrier, 1));
    } else if (has_ended(sent)) {
      MPI_Ibarrier(comm_, &barrier);
      is_waiting = true;
    }
  }
  std::sort(from.begin(), from.end(), [](const Count& a, const Count& b) { return a.rank < b.rank; });
  return from;
}

void Communicator::exchange_messages(std::span<const Outgoing> out, std::span<const Incoming> in,
                                     std::size_t largest_piece) const {
  std::vector<MPI_Request> requests;
  for (const Incoming& message : in) {
    for_pieces(message.bytes.size(), largest_piece, [&](std::size_t begin, int length) {
      MPI_Irecv(message.bytes.data() + begin, length, MPI_BYTE, message.from, 1, comm_,
                &requests.emplace_back());
    });
  }
  for (const Outgoing& message : out) {
    for_pieces(message.bytes.size(), largest_piece, [&](std::size_t begin, int length) {
      MPI_Isend(message.bytes.data() + begin, length, MPI_BYTE, message.to, 1, comm_,
                &requests.emplace_back());
    });
  }
  MPI_Waitall(size32(requests), requests.data(), MPI_STATUSES_IGNORE);
}

void Communicator::send_bytes(std::span<const std::byte> bytes, int to) const {
  const std::uint64_t size = bytes.size();
  MPI_Ssend(&size, 1, MPI_UINT64_T, to, 2, comm_);  // waits for the receiver
  for_pieces(bytes.size(), largest_message, [&](std::size_t begin, int length) {
    MPI_Send(bytes.data() + begin, length, MPI_BYTE, to, 3, comm_);
  });
}

std::vector<std::byte> Communicator::receive_bytes(int from) const {
  std::uint64_t size = 0;
  MPI_Recv(&size, 1, MPI_UINT64_T, from, 2, comm_, MPI_STATUS_IGNORE);
  std::vector<std::byte> bytes(size);
  for_pieces(bytes.size(), largest_message, [&](std::size_t begin, int length) {
    MPI_Recv(bytes.data() + begin, length, MPI_BYTE, from, 3, comm_, MPI_STATUS_IGNORE);
  });
  return bytes;
}

void Communicator::together(const std::function<void()>& local) const {
  std::string message;
  auto status = ExitStatus::done;
  try {
    local();
  } catch (const Error& error) {
    status = error.status();
    message = error.what();
  } catch (const std::bad_alloc&) {
    status = ExitStatus::bad_input;
    message = out_of_memory;
  } catch (const std::exception& error) {
    status = ExitStatus::fault;
    message = error.what();
  }
  const auto failed_rank = minimum(std::int64_t{status == ExitStatus::done ? size_ : rank_});
  if (failed_rank == size_) return;
  message.insert(message.begin(), static_cast<char>(status));
  std::vector<char> agreed(message.begin(), message.end());
  broadcast(agreed, static_cast<int>(failed_rank));
  rethrow(static_cast<ExitStatus>(agreed.front()), std::string(agreed.begin() + 1, agreed.end()));
}

void Communicator::on_first(const std::function<void()>& local) const {
  together([&] {
    std::exception_ptr error;
    try {
      if (is_root()) local();
    } catch (...) {
      error = std::current_exception();
    }
    patient_barrier();
    if (error) std::rethrow_exception(error);
  });
}

std::vector<std::string> broadcast_words(const Communicator& comm, const std::vector<std::string>& words,
                                         int from) {
  std::vector<char> text;
  for (const std::string& word : words) text.insert(text.end(), word.c_str(), word.c_str() + word.size() + 1);
  comm.broadcast(text, from);
  std::vector<std::string> shared;
  for (auto at = text.begin(); at != text.end();) {
    const auto end = std::find(at, text.end(), '\0');
    shared.emplace_back(at, end);
    at = end + 1;
  }
  return shared;
}

}  // namespace quadloop
