#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/files/interruption.hpp"

namespace quadloop {

/// A folder that is itself an output: where it was made for it, it goes again, empty, unless it is kept. On
/// one rank.
class NewFolder {
 public:
  /// Makes it, unless it is there already. Throws OutputError where it cannot be made, or holds anything but
  /// `files` (names that begin with a dot do not count).
  static NewFolder at(const std::string& path, const std::vector<std::string>& files);
  ~NewFolder();
  NewFolder(NewFolder&&) = default;
  NewFolder& operator=(NewFolder&&) = delete;

  void keep() { made_.reset(); }

 private:
  NewFolder() = default;
  std::unique_ptr<Temporary> made_;
};

}  // namespace quadloop
