#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quadloop {

/// The words by which users choose among the values of an enumeration, in the order in which messages list
/// them: the one place where a new value gets its word.
template <class Value, std::size_t count>
using WordTable = std::array<std::pair<const char*, Value>, count>;

template <class Value, std::size_t count>
std::vector<std::string> words_of(const WordTable<Value, count>& table) {
  std::vector<std::string> words;
  for (const auto& [word, value] : table) words.emplace_back(word);
  return words;
}

/// The value that a word stands for; none where it is not in the table.
template <class Value, std::size_t count>
constexpr std::optional<Value> value_of(const WordTable<Value, count>& table, std::string_view word) {
  for (const auto& [known, value] : table) {
    if (word == known) return value;
  }
  return std::nullopt;
}

/// The first word for a value, which must be in the table.
template <class Value, std::size_t count>
constexpr const char* word_of(const WordTable<Value, count>& table, Value value) {
  std::size_t i = 0;
  while (table[i].second != value) ++i;
  return table[i].first;
}

}  // namespace quadloop
