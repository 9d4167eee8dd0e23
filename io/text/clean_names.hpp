#pragma once

#include <span>
#include <string>
#include <vector>

namespace quadloop {

/// Makes names from a file such that every writer and terminal can hold them: text that is no UTF-8 is taken
/// as Latin-1, and each control character becomes "_". Different names stay different. Where names were
/// changed, the result is one line on them that begins with `where`, for a warning; else it is empty.
std::vector<std::string> clean_names(std::span<std::string* const> names, const std::string& where);

}  // namespace quadloop
