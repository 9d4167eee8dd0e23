#pragma once

#include <memory>
#include <string>

namespace quadloop::io {

/// To be called once, at the start of a program, after MPI_Init: from then on a signal that ends this process
/// (interrupt, termination, crash), and exit(), first remove the temporaries below; the process then ends as
/// it would have. Ignored signals remain ignored. Exceeding the file size limit becomes a write error instead
/// of a signal. The calling thread must be the one that uses temporaries.
void remove_temporaries_when_killed();

/// A file, or an empty folder, that is removed if a signal kills the process. Must be registered before it is
/// created.
class Temporary {
 public:
  explicit Temporary(std::string path);
  ~Temporary();
  Temporary(Temporary&& other) noexcept;
  Temporary& operator=(Temporary&&) = delete;

  const std::string& path() const;

 private:
  struct Entry;
  friend void remove_registered_temporaries();
  Entry* entry_ = nullptr;
};

/// While an object exists, SIGUSR1 does not end the process: it requests that the run ends at its next
/// checkpoint. If the signal is ignored, it remains ignored.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  /// Whether this process has received the signal.
  bool has_come() const;

 private:
  struct Former;
  std::unique_ptr<Former> former_;
};

/// While an object exists, signals that would end the process are delayed.
class SignalsWait {
 public:
  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

  /// Whether a delayed signal will end the process when the last object is destroyed.
  static bool has_come();
};

}  // namespace quadloop::io
