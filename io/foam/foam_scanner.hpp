#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace quadloop::io {

/// Tokens of an OpenFOAM text file, in memory: words and numbers, and each of ( ) { } ; separately; comments
/// are skipped. Errors are InputErrors "file:line: ...".
class FoamScanner {
 public:
  /// Skips the file's header, which must be that of an ASCII file.
  explicit FoamScanner(std::string path);

  bool at_end();
  std::string_view token(std::string_view expected);
  void expect(std::string_view sign);
  std::int64_t integer(std::string_view expected);
  double real(std::string_view expected);
  /// Reads the size of a list and its "("; the size must not exceed what the rest of the file can contain
  /// with `bytes_each` bytes per entry.
  std::size_t begin_list(const std::string& of, std::size_t bytes_each);
  /// Call after the entries of a list: expects ")" and nothing else.
  void end_file();

  [[noreturn]] void refuse(const std::string& message) const;

 private:
  void skip();
  void skip_header();

  std::string path_, text_;
  std::size_t at_ = 0, token_ = 0;
};

}  // namespace quadloop::io
