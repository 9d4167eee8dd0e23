#include "mesher/base/nearest_word.hpp"

#include <algorithm>
#include <cctype>

namespace quadloop {

namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Returns the number of typing errors between two words (optimal string alignment distance).
std::size_t slips_between(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
    before_last = last;
    last = row;
  }
  return last[b.size()];
}

/// Whether one of two words is a prefix of the other, e.g. max and maximum.
bool one_begins_other(std::string_view a, std::string_view b) {
  constexpr std::size_t least = 3;
  const std::size_t shorter = std::min(a.size(), b.size());
  return shorter >= least && slips_between(a.substr(0, shorter), b.substr(0, shorter)) == 0;
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& words) {
  std::string nearest;
  std::size_t fewest = std::max<std::size_t>(1, word.size() / 3) + 1;
  for (const std::string& candidate : words) {
    const std::size_t slips = slips_between(word, candidate);
    if (slips >= fewest || slips >= candidate.size()) continue;
    fewest = slips;
    nearest = candidate;
  }
  if (!nearest.empty()) return nearest;
  const auto begun = std::ranges::find_if(
      words, [&](const std::string& candidate) { return one_begins_other(word, candidate); });
  return begun == words.end() ? "" : *begun;
}

std::string guess_for(std::string_view word, const std::vector<std::string>& words) {
  const std::string nearest = nearest_word(word, words);
  return nearest.empty() ? "" : "; do you mean '" + nearest + "'?";
}

std::string first_few(const std::vector<std::string>& words) {
  constexpr std::size_t most = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, words.size()); ++i) text += (i == 0 ? "" : ", ") + words[i];
  return words.size() > most ? text + " and " + std::to_string(words.size() - most) + " more" : text;
}

}  // namespace quadloop
