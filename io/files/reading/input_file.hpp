#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::io {

class InputDescriptor;

/// Throws InputError if the path is not a readable file: nothing there, a name too long, a folder, a device
/// (which may be endless), a pipe.
void require_input_file(const std::string& path);

/// Returns all bytes of a user's text file, or of a pipe if allowed and it ends in time. Throws InputError.
std::string read_input(const std::string& path);

/// Reads a file piece by piece.
class InputPieces {
 public:
  /// Opens it; throws InputError.
  explicit InputPieces(const std::string& path);
  ~InputPieces();

  /// Appends about a megabyte, nothing at the end. Throws InputError.
  void append_next(std::string& text);
  /// Reads exactly `size` bytes. Throws InputError, also if the file ends before.
  void read_all(char* into, std::size_t size);
  /// Number of bytes not read yet; 0 for a pipe, where it is unknown.
  std::size_t bytes_left() const { return bytes_left_; }

 private:
  std::string path_;
  std::unique_ptr<InputDescriptor> file_;
  bool is_pipe_ = false;
  std::size_t bytes_left_ = 0, taken_ = 0;
};

/// A file that is read at any place.
class PlacedInput {
 public:
  /// Opens it; throws InputError, also for a pipe, unless that is to be kept in memory, and read_input()
  /// accepts it.
  explicit PlacedInput(const std::string& path, bool keeps_pipe = false);
  ~PlacedInput();

  /// In bytes, when it was opened.
  std::int64_t size() const { return size_; }
  /// Reads all these bytes from an offset in the file. Throws InputError, also if the file ends before.
  void read_at(std::int64_t place, std::span<std::byte> into) const;

 private:
  std::string path_;
  std::unique_ptr<InputDescriptor> file_;  ///< none for a pipe
  std::string kept_;                       ///< what came through it
  std::int64_t size_ = 0;
};

/// Throws InputError unless a file, opened by all ranks, has the same size on each. *Collective.*
void require_same_size(const Communicator& comm, const std::string& path, std::int64_t size);

/// Sets whether read_input() accepts pipes; initially it does not. Only for reading on one rank: data read
/// from a pipe are lost for the others.
void allow_piped_input(bool allowed);

}  // namespace quadloop::io
