#pragma once

#include <functional>
#include <string>

#include "mesher/base/error.hpp"

namespace quadloop::test {

/// A folder of this test alone, the same on all ranks, removed with everything in it. *Collective.*
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  /// Writes a file, on the root, below folders that are made for it; all ranks wait for it. Returns its path.
  /// *Collective.*
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::string path_;
};

std::string bytes_of(const std::string& path);

/// The message of the error of this kind that `call` throws; empty where it throws none.
template <class Kind = InputError>
std::string refusal_text(const std::function<void()>& call) {
  try {
    call();
    return {};
  } catch (const Kind& error) {
    return error.what();
  }
}

}  // namespace quadloop::test
