#pragma once

#include <string>

#include "io/model/loaded_mesh.hpp"

namespace quadloop::test {

/// A text with the first occurrence of `what` exchanged; a test failure where there is none.
std::string replaced(std::string text, const std::string& what, const std::string& with);

/// The same text with the line ends of Windows.
std::string with_crlf(const std::string& text);

/// Reads texts as if they were the file `name`, on one rank.
struct ReaderCheck {
  io::LoadedMesh (*read)(const std::string& path);
  std::string name;

  io::LoadedMesh of(const std::string& text) const;

  /// Expects the refusal "name:line: ..." to begin with `begins` and to contain `says`.
  void expect_refusal(const std::string& text, const std::string& begins, const std::string& says) const;

  /// Expects that the text is refused when it lacks its last line, its last two, and so on.
  void expect_early_ends_refused(const std::string& text) const;
};

}  // namespace quadloop::test
