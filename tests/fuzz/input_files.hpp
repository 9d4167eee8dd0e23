#pragma once

#include <string>
#include <string_view>

namespace quadloop::fuzz {

/// A folder of this process alone, removed at its end.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Its path for a file or folder of that name.
  std::string file(std::string_view name) const { return path_ + "/" + std::string(name); }
  void clear() const;

 private:
  std::string path_;
};

/// Empties the folder and writes an input to it as the file `name`. An input that begins with a line
/// "=== PATH" holds several files: each is what follows such a line, as far as the next one. Throws
/// InputError for a path that leads out of the folder.
void write_input(const Folder& folder, std::string_view name, std::string_view input);

}  // namespace quadloop::fuzz
