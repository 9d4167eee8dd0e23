#pragma once

#include <string>
#include <utility>

namespace quadloop {

/// The owner of one file descriptor. Its number is 10 or more, so that it never stands where a child process
/// wants another, and programs that are started do not inherit it.
class Descriptor {
 public:
  Descriptor() = default;
  /// Takes over `raw`, which may be closed for a higher number.
  explicit Descriptor(int raw);
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : number_{std::exchange(other.number_, -1)} {}
  Descriptor& operator=(Descriptor&& other) noexcept;

  int number() const { return number_; }
  void close();

 private:
  int number_ = -1;
};

/// open(2); an OutputError names the path.
Descriptor open_descriptor(const std::string& path, int flags);

struct Pipe {
  Descriptor reading, writing;
};

Pipe make_pipe();

}  // namespace quadloop
