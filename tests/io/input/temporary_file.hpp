#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace quadloop::test {

/// A folder of its own for one test, gone when the test ends.
class InputFolder {
 public:
  InputFolder();
  ~InputFolder();
  InputFolder(const InputFolder&) = delete;
  InputFolder& operator=(const InputFolder&) = delete;

  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& text) const;
  std::filesystem::path path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The message of the InputError that the call must throw, with `folder` cut out of it.
std::string refusal(const InputFolder& folder, const std::function<void()>& call);

}  // namespace quadloop::test
