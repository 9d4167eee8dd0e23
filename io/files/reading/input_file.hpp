#pragma once

#include <cstddef>
#include <memory>
#include <string>

namespace quadloop {

class InputDescriptor;

/// Throws InputError where no file can be read at the path: nothing there, a name too long, a folder, a
/// device (which may have no end), a pipe.
void require_input_file(const std::string& path);

/// All bytes of a text file that a user gave; also of a pipe, where that is allowed, as long as it ends in
/// time. Throws InputError.
std::string read_input(const std::string& path);

/// The same file piece by piece, for who need not hold it whole.
class InputPieces {
 public:
  /// Opens it; throws InputError.
  explicit InputPieces(const std::string& path);
  ~InputPieces();

  /// Appends about a megabyte, at its end nothing. Throws InputError.
  void append_next(std::string& text);
  /// Exactly so many bytes. Throws InputError, also where the file ends before.
  void read_all(char* into, std::size_t size);
  /// Bytes not read yet; of a pipe, which does not tell, 0.
  std::size_t bytes_left() const { return bytes_left_; }

 private:
  std::string path_;
  std::unique_ptr<InputDescriptor> file_;
  bool is_pipe_ = false;
  std::size_t bytes_left_ = 0, taken_ = 0;
};

/// Whether read_input() takes pipes; at first it does not. Only where one rank reads: what it takes from a
/// pipe is gone for the others.
void allow_piped_input(bool allowed);

}  // namespace quadloop
