#pragma once

#include <span>
#include <string>
#include <vector>

namespace quadloop::io {

/// Changes names from a file such that every writer and terminal supports them: text that is not UTF-8 is
/// taken as Latin-1, and each control character becomes "_". Distinct names remain distinct. If names were
/// changed, returns one line that begins with `where`, for a warning; else an empty string.
std::vector<std::string> clean_names(std::span<std::string* const> names, const std::string& where);

}  // namespace quadloop::io
