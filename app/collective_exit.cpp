#include "app/collective_exit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/base/progress.hpp"
#include "mesher/base/utf8.hpp"

namespace quadloop::app {

namespace {

using Clock = std::chrono::steady_clock;
constexpr int failure_note = 7;  // the tag of "I have failed"
// maximum delay between ranks that encounter the same error
constexpr auto patience = std::chrono::milliseconds(2000);

bool print(const std::string& record) {
  return std::fputs(record.c_str(), stdout) >= 0 && std::fflush(stdout) == 0;
}

void print_line(const char* kind, std::string text) {
  for (char& c : text) c = c == '\n' || c == '\r' ? ' ' : c;
  fmt::print(stderr, "quadloop: {}: {}\n", kind, printable(text));
}

void say(const Outcome& outcome) {
  print(outcome.record);
  progress::clear();
  for (const std::string& warning : outcome.warnings) print_line("warning", warning);
  print_line(outcome.status == ExitStatus::stopped ? "stopped" : "error", outcome.message);
  std::fflush(stderr);
}

bool completes_within(MPI_Request& request, std::chrono::milliseconds time) {
  const auto deadline = Clock::now() + time;
  for (;;) {
    int done = 0;
    MPI_Test(&request, &done, MPI_STATUS_IGNORE);
    if (done != 0) return true;
    if (Clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// Notifies all other ranks that this one failed. The messages are small enough to be sent without a matching
/// receive.
void send_notes(MPI_Comm comm, int rank, int ranks, std::vector<MPI_Request>& notes) {
  static const char note = 1;
  for (int r = 0; r < ranks; ++r) {
    if (r != rank) MPI_Isend(&note, 1, MPI_CHAR, r, failure_note, comm, &notes.emplace_back());
  }
}

void receive_notes(MPI_Comm comm, int rank, const std::vector<int>& statuses) {
  char note = 0;
  for (int r = 0; r < std::ssize(statuses); ++r) {
    if (r != rank && statuses[r] != 0) MPI_Recv(&note, 1, MPI_CHAR, r, failure_note, comm, MPI_STATUS_IGNORE);
  }
}

bool lower_rank_failed(MPI_Comm comm, int rank) {
  for (int r = 0; r < rank; ++r) {
    int there = 0;
    MPI_Iprobe(r, failure_note, comm, &there, MPI_STATUS_IGNORE);
    if (there != 0) return true;
  }
  return false;
}

/// The others wait for this rank elsewhere. The lowest failed rank prints the message and aborts them.
[[noreturn]] void end_all(MPI_Comm comm, int rank, const Outcome& outcome) {
  if (lower_rank_failed(comm, rank))
    std::this_thread::sleep_for(std::chrono::seconds(20));  // aborted by that rank before this ends
  else
    say(outcome);
  MPI_Abort(comm, static_cast<int>(outcome.status));
  std::abort();
}

}  // namespace

ExitStatus close_together(MPI_Comm comm, const Outcome& outcome) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(comm, &rank);
  MPI_Comm_size(comm, &ranks);
  const int mine = static_cast<int>(outcome.status);
  std::vector<MPI_Request> notes;
  if (mine != 0) send_notes(comm, rank, ranks, notes);
  std::vector<int> statuses(ranks);
  MPI_Request agreed = MPI_REQUEST_NULL;
  MPI_Iallgather(&mine, 1, MPI_INT, statuses.data(), 1, MPI_INT, comm, &agreed);
  if (mine != 0 && !completes_within(agreed, patience)) end_all(comm, rank, outcome);
  MPI_Wait(&agreed, MPI_STATUS_IGNORE);
  receive_notes(comm, rank, statuses);
  MPI_Waitall(size32(notes), notes.data(), MPI_STATUSES_IGNORE);
  const auto first = std::find_if(statuses.begin(), statuses.end(), [](int status) { return status != 0; });
  if (first == statuses.end()) {
    if (rank != 0 || print(outcome.record)) return ExitStatus::done;
    say({ExitStatus::output_failed, "standard output cannot be written"});
    return ExitStatus::output_failed;
  }
  if (first - statuses.begin() == rank) say(outcome);
  return static_cast<ExitStatus>(*first);
}

}  // namespace quadloop::app
