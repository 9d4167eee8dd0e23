#include "io/files/interruption.hpp"

#include <pthread.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <utility>

namespace quadloop::io {

struct Temporary::Entry {
  std::string path;
  std::atomic<Entry*> next = nullptr;
  Entry* before = nullptr;  ///< not for the handler
};

namespace {

constexpr std::array requests{SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU};
constexpr std::array crashes{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};

/// Accessed by the handler, which runs on the thread that changes these, between two of its steps.
std::atomic<void*> newest_entry = nullptr;
std::atomic<int> waits = 0;
std::atomic<int> waiting_signal = 0;
std::atomic<bool> stop_requested = false;
pid_t owner_process = 0;
pthread_t owner_thread = {};
std::array<struct sigaction, NSIG> former_actions = {};

bool is_crash(int number) {
  for (const int crash : crashes) {
    if (crash == number) return true;
  }
  return false;
}

}  // namespace

/// Async-signal-safe. Files are removed first, so that their folder is empty.
void remove_registered_temporaries() {
  using Entry = Temporary::Entry;
  for (const auto remove : {&::unlink, &::rmdir}) {
    for (auto* entry = static_cast<Entry*>(newest_entry.load()); entry != nullptr; entry = entry->next)
      remove(entry->path.c_str());
  }
}

namespace {

void end_cleanly(int number, siginfo_t* information, void*) {
  const int error_before = errno;
  const bool crash = is_crash(number), here = ::pthread_equal(::pthread_self(), owner_thread) != 0;
  if (::getpid() == owner_process) {
    if (!crash && !here) {
      ::pthread_kill(owner_thread, number);
      return;
    }
    if (!crash && waits > 0) {
      waiting_signal = number;
      return;
    }
    if (here) remove_registered_temporaries();
  }
  ::sigaction(number, &former_actions[number], nullptr);
  const bool repeats_itself = crash && number != SIGABRT && information->si_code > 0;
  if (!repeats_itself) ::raise(number);  // delivered after this handler returns
  errno = error_before;
}

void handle(int number) {
  struct sigaction& former = former_actions[number];
  ::sigaction(number, nullptr, &former);
  if (former.sa_handler == SIG_IGN || (!is_crash(number) && former.sa_handler != SIG_DFL)) return;
  struct sigaction action = {};
  action.sa_sigaction = end_cleanly;
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  ::sigaction(number, &action, nullptr);
}

}  // namespace

void remove_temporaries_when_killed() {
  owner_process = ::getpid();
  owner_thread = ::pthread_self();
  ::signal(SIGXFSZ, SIG_IGN);
  std::atexit([] {  // for libraries that end the process
    if (::getpid() == owner_process) remove_registered_temporaries();
  });
  for (const int number : requests) handle(number);
  for (const int number : crashes) handle(number);
}

Temporary::Temporary(std::string path) : entry_{new Entry{std::move(path)}} {
  auto* const next = static_cast<Entry*>(newest_entry.load());
  entry_->next = next;
  if (next != nullptr) next->before = entry_;
  newest_entry = entry_;
}

Temporary::~Temporary() {
  if (entry_ == nullptr) return;
  Entry* const next = entry_->next;
  if (entry_->before == nullptr)
    newest_entry = next;
  else
    entry_->before->next = next;
  if (next != nullptr) next->before = entry_->before;
  delete entry_;
}

Temporary::Temporary(Temporary&& other) noexcept : entry_{std::exchange(other.entry_, nullptr)} {}

const std::string& Temporary::path() const { return entry_->path; }

struct StopRequest::Former {
  struct sigaction action = {};
};

StopRequest::StopRequest() : former_{std::make_unique<Former>()} {
  stop_requested = false;
  ::sigaction(SIGUSR1, nullptr, &former_->action);
  if (former_->action.sa_handler == SIG_IGN) return;
  struct sigaction action = {};
  action.sa_handler = [](int) { stop_requested = true; };
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGUSR1, &action, nullptr);
}

StopRequest::~StopRequest() { ::sigaction(SIGUSR1, &former_->action, nullptr); }

bool StopRequest::has_come() const { return stop_requested; }

SignalsWait::SignalsWait() { ++waits; }

bool SignalsWait::has_come() { return waiting_signal != 0; }

SignalsWait::~SignalsWait() {
  if (--waits > 0) return;
  const int number = waiting_signal.exchange(0);
  if (number != 0) ::raise(number);
}

}  // namespace quadloop::io
