#pragma once

#include <string>

namespace quadloop {

/// Once, at the start of a program, after MPI_Init: from here on a signal that ends this process (an
/// interrupt, a termination, a crash), and exit(), first remove the temporaries below; the process then ends
/// as it would have. Signals that are ignored stay so. A file that grows beyond the limit of files' sizes is
/// an error of the write, not a signal. The calling thread is the one that works with temporaries.
void remove_temporaries_when_killed();

/// A file, or an empty folder, that goes when the process is killed by a signal. Named before it is made.
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

/// While one exists, a signal that would end the process waits.
class SignalsWait {
 public:
  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;

  /// Whether one has come that ends the process when the last of these is gone.
  static bool has_come();
};

}  // namespace quadloop
