#include "mesher/base/communicator.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <new>
#include <string>
#include <thread>

#include "mesher/base/error.hpp"
#include "mesher/base/free_memory.hpp"

namespace quadloop {

namespace {

constexpr auto shortest_nap = std::chrono::microseconds(100), longest_nap = std::chrono::microseconds(10000);
constexpr std::size_t largest_message = std::size_t{1}
                                        << 30;  // MPI counts are 32-bit: longer data go in pieces

template <class T>
T reduced(T value, MPI_Datatype type, MPI_Op operation, MPI_Comm comm) {
  T result{};
  MPI_Allreduce(&value, &result, 1, type, operation, comm);
  return result;
}

/// Refused rather than cut short: collective pieces are bounded by the callers.
int count_of(std::size_t size) {
  QUADLOOP_REQUIRE(size <= largest_message, "a collective message of more than 1 GiB");
  return static_cast<int>(size);
}

std::vector<int> offsets_of(const std::vector<int>& counts) {
  std::vector<int> offsets(counts.size() + 1, 0);
  for (std::size_t r = 0; r < counts.size(); ++r) {
    offsets[r + 1] = count_of(static_cast<std::size_t>(offsets[r]) + static_cast<std::size_t>(counts[r]));
  }
  return offsets;
}

/// The same kind of error on every rank, whichever rank met it.
[[noreturn]] void rethrow(ExitStatus status, const std::string& message) {
  switch (status) {
    case ExitStatus::bad_input: throw InputError(message);
    case ExitStatus::wrong_usage: throw UsageError(message);
    case ExitStatus::solver_failed: throw SolverError(message);
    case ExitStatus::output_failed: throw OutputError(message);
    case ExitStatus::fault: throw Fault(message);
    default: throw Error(status, message);
  }
}

}  // namespace

Communicator::Communicator(MPI_Comm to_duplicate) {
  MPI_Comm_dup(to_duplicate, &comm_);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
}

Communicator::~Communicator() { MPI_Comm_free(&comm_); }

std::int64_t Communicator::sum(std::int64_t value) const {
  return reduced(value, MPI_INT64_T, MPI_SUM, comm_);
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
  std::vector<int> counts(static_cast<std::size_t>(size_));
  MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm_);
  const std::vector<int> offsets = offsets_of(counts);
  std::vector<std::byte> all(static_cast<std::size_t>(offsets.back()));
  MPI_Allgatherv(bytes.data(), mine, MPI_BYTE, all.data(), counts.data(), offsets.data(), MPI_BYTE, comm_);
  return all;
}

void Communicator::broadcast_bytes(std::vector<std::byte>& bytes) const {
  std::uint64_t size = bytes.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, comm_);
  bytes.resize(size);
  for (std::size_t begin = 0; begin < size; begin += largest_message) {
    MPI_Bcast(bytes.data() + begin, count_of(std::min(largest_message, size - begin)), MPI_BYTE, 0, comm_);
  }
}

std::vector<std::vector<std::byte>> Communicator::exchange_bytes(
    const std::vector<std::span<const std::byte>>& to_rank) const {
  const auto ranks = static_cast<std::size_t>(size_);
  std::vector<int> send_counts(ranks), receive_counts(ranks);
  for (std::size_t r = 0; r < ranks; ++r) send_counts[r] = count_of(to_rank[r].size());
  MPI_Alltoall(send_counts.data(), 1, MPI_INT, receive_counts.data(), 1, MPI_INT, comm_);
  std::vector<std::vector<std::byte>> received(ranks);
  std::vector<MPI_Request> requests;
  for (std::size_t r = 0; r < ranks; ++r) {
    received[r].resize(static_cast<std::size_t>(receive_counts[r]));
    if (receive_counts[r] == 0) continue;
    MPI_Irecv(received[r].data(), receive_counts[r], MPI_BYTE, static_cast<int>(r), 1, comm_,
              &requests.emplace_back());
  }
  for (std::size_t r = 0; r < ranks; ++r) {
    if (send_counts[r] == 0) continue;
    MPI_Isend(to_rank[r].data(), send_counts[r], MPI_BYTE, static_cast<int>(r), 1, comm_,
              &requests.emplace_back());
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  return received;
}

void Communicator::send_bytes(std::span<const std::byte> bytes, int to) const {
  const std::uint64_t size = bytes.size();
  MPI_Send(&size, 1, MPI_UINT64_T, to, 2, comm_);
  for (std::size_t begin = 0; begin < size; begin += largest_message) {
    MPI_Send(bytes.data() + begin, count_of(std::min(largest_message, size - begin)), MPI_BYTE, to, 3, comm_);
  }
}

std::vector<std::byte> Communicator::receive_bytes(int from) const {
  std::uint64_t size = 0;
  MPI_Recv(&size, 1, MPI_UINT64_T, from, 2, comm_, MPI_STATUS_IGNORE);
  std::vector<std::byte> bytes(size);
  for (std::size_t begin = 0; begin < size; begin += largest_message) {
    MPI_Recv(bytes.data() + begin, count_of(std::min(largest_message, size - begin)), MPI_BYTE, from, 3,
             comm_, MPI_STATUS_IGNORE);
  }
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
  std::vector<char> text(message.begin(), message.end());
  std::vector<std::vector<char>> to_rank(static_cast<std::size_t>(size_));
  if (rank_ == failed_rank) {
    text.insert(text.begin(), static_cast<char>(status));
    for (auto& copy : to_rank) copy = text;
  }
  const std::vector<char> agreed = exchange(to_rank)[static_cast<std::size_t>(failed_rank)];
  rethrow(static_cast<ExitStatus>(agreed.front()), std::string(agreed.begin() + 1, agreed.end()));
}

}  // namespace quadloop
