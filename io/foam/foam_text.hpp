#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace quadloop::io {

/// Replaces comments by blanks, so that positions do not change.
std::string without_foam_comments(std::string text);

/// An entry of a dictionary: its key, without quotes, and the position of its value in the text: up to the
/// semicolon or, for a sub-dictionary, the contents of its braces.
struct FoamEntry {
  std::string key;
  std::size_t begin = 0, end = 0;
  bool is_block = false;
};

/// Returns the entries between two positions of a text without comments, excluding those of sub-dictionaries.
/// Directives, e.g. #include, and unterminated entries are skipped.
std::vector<FoamEntry> foam_entries(const std::string& text, std::size_t begin = 0,
                                    std::size_t end = std::string::npos);

/// Returns the last of several entries with this key, as OpenFOAM does.
std::optional<FoamEntry> foam_entry(const std::vector<FoamEntry>& entries, const std::string& key);

/// Returns the first word of a value, without quotes.
std::string foam_word(const std::string& text, const FoamEntry& entry);

/// Whether a word switches something on in OpenFOAM.
bool is_foam_true(const std::string& word);

}  // namespace quadloop::io
