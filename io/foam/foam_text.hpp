#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace quadloop {

/// Comments become blanks, so that places stay.
std::string without_foam_comments(std::string text);

/// An entry of a dictionary: its key, without quotes, and where its value stands in the text: up to the
/// semicolon, or of a sub-dictionary what is between its braces.
struct FoamEntry {
  std::string key;
  std::size_t begin = 0, end = 0;
  bool is_block = false;
};

/// The entries between two places of a text without comments, not those of the sub-dictionaries in it.
/// Directives, as #include, are passed over, and what does not end.
std::vector<FoamEntry> foam_entries(const std::string& text, std::size_t begin = 0,
                                    std::size_t end = std::string::npos);

/// Of several the last, as OpenFOAM takes it.
std::optional<FoamEntry> foam_entry(const std::vector<FoamEntry>& entries, const std::string& key);

/// The first word of a value, without quotes.
std::string foam_word(const std::string& text, const FoamEntry& entry);

/// As OpenFOAM writes them: switches that are on.
bool is_foam_true(const std::string& word);

}  // namespace quadloop
