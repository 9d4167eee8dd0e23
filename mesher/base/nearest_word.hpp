#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quadloop {

/// Returns the most likely intended word of `words` for a mistyped `word`: the one with the fewest changed,
/// added, omitted or transposed letters, at most a third of its letters, ignoring case. If there is none, one
/// that starts with `word`, or that `word` starts with. The first of equally close ones; empty if there is
/// none.
std::string nearest_word(std::string_view word, const std::vector<std::string>& words);

/// Returns "; do you mean 'X'?" with the nearest word; empty if there is none.
std::string guess_for(std::string_view word, const std::vector<std::string>& words);

/// Returns the first words for a message about a mistyped one: "a, b, c and 9 more".
std::string first_few(const std::vector<std::string>& words);

}  // namespace quadloop
