#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace quadloop {

/// The tokens of one of OpenFOAM's text files, held whole: words and numbers, and each of ( ) { } ; for
/// itself; comments are passed over. Refusals are InputErrors "file:line: ...".
class FoamScanner {
 public:
  /// Passes over the file's header, which must be that of an ASCII file.
  explicit FoamScanner(std::string path);

  bool at_end();
  std::string_view token(std::string_view expected);
  void expect(std::string_view sign);
  std::int64_t integer(std::string_view expected);
  double real(std::string_view expected);
  /// The size of a list and its "(": at most as many as the file can still hold, of so many bytes each.
  std::size_t begin_list(const std::string& of, std::size_t bytes_each);
  /// After the entries of a list: its ")" and nothing else.
  void end_file();

  [[noreturn]] void refuse(const std::string& message) const;

 private:
  void skip();
  void skip_header();

  std::string path_, text_;
  std::size_t at_ = 0, token_ = 0;
};

}  // namespace quadloop
