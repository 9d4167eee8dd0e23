#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

namespace quadloop {

/// Converts ASCII letters to lower case, in any locale.
inline std::string small_letters(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
  });
  return text;
}

/// Returns the suffix of a file name with its dot, in lower case, as some programs write .MSH or .DXF.
inline std::string suffix_of(const std::string& path) {
  return small_letters(std::filesystem::path(path).extension().string());
}

}  // namespace quadloop
