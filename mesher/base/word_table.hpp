#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quadloop {

/// The words for the values of an enumeration in user input, in the order in which messages list them.
template <class Value, std::size_t count>
using WordTable = std::array<std::pair<const char*, Value>, count>;

template <class Value, std::size_t count>
std::vector<std::string> words_of(const WordTable<Value, count>& table) {
  std::vector<std::string> words;
  for (const auto& [word, value] : table) words.emplace_back(word);
  return words;
}

/// Returns the value of a word; empty if it is not in the table.
template <class Value, std::size_t count>
constexpr std::optional<Value> value_of(const WordTable<Value, count>& table, std::string_view word) {
  for (const auto& [known, value] : table) {
    if (word == known) return value;
  }
  return std::nullopt;
}

/// Returns the first word for a value, which must be in the table.
template <class Value, std::size_t count>
constexpr const char* word_of(const WordTable<Value, count>& table, Value value) {
  std::size_t i = 0;
  while (table[i].second != value) ++i;
  return table[i].first;
}

}  // namespace quadloop
