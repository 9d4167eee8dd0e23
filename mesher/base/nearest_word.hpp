#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quadloop {

/// The one of `words` that `word` is most likely a slip for: the fewest letters changed, added, left out or
/// swapped with their neighbour, and no more than a third of its letters; letters of either case are the
/// same. Where none is so near, one that begins with `word`, or that `word` begins with. The first of several
/// that are equally near; empty where there is none.
std::string nearest_word(std::string_view word, const std::vector<std::string>& words);

/// "; do you mean 'X'?" with the nearest word; empty where none is near.
std::string guess_for(std::string_view word, const std::vector<std::string>& words);

/// The first words, for a user who mistyped one: "a, b, c and 9 more".
std::string first_few(const std::vector<std::string>& words);

}  // namespace quadloop
