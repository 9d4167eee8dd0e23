#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

namespace quadloop {

/// With the letters of ASCII made small, in any locale.
inline std::string small_letters(std::string text) {
  std::ranges::transform(text, text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
  });
  return text;
}

/// The suffix of a file's name with its dot, in small letters: programs of other systems write .MSH and .DXF.
inline std::string suffix_of(const std::string& path) {
  return small_letters(std::filesystem::path(path).extension().string());
}

}  // namespace quadloop
