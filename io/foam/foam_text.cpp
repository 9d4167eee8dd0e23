#include "io/foam/foam_text.hpp"

#include <algorithm>
#include <string_view>

namespace quadloop::io {

namespace {

constexpr const char* blanks = " \t\r\n\f\v";

class Entries {
 public:
  Entries(const std::string& text, std::size_t begin, std::size_t end)
      : text_{text}, at_{begin}, end_{std::min(end, text.size())} {}

  std::vector<FoamEntry> all() {
    std::vector<FoamEntry> entries;
    while (skip(std::string(blanks) + ";})"), at_ < end_) {
      if (text_[at_] == '#') {
        at_ = text_.find('\n', at_);
        continue;
      }
      FoamEntry entry{key(), 0, 0, false};
      skip(blanks);
      if (at_ >= end_ || !read_value(entry)) break;
      entries.push_back(std::move(entry));
    }
    return entries;
  }

 private:
  void skip(const std::string& signs) { at_ = std::min(text_.find_first_not_of(signs, at_), end_); }

  std::string key() {
    const bool quoted = text_[at_] == '"';
    const std::size_t begin = quoted ? at_ + 1 : at_;
    const std::size_t found = quoted ? text_.find('"', begin) : text_.find_first_of(" \t\r\n\f\v;{", begin);
    const std::size_t end = std::min(found, end_);
    at_ = quoted ? std::min(end + 1, end_) : end;
    return text_.substr(begin, end - begin);
  }

  /// Returns false if the value has no end.
  bool read_value(FoamEntry& entry) {
    entry.is_block = text_[at_] == '{';
    entry.begin = entry.is_block ? ++at_ : at_;
    for (int depth = 0; at_ < end_; ++at_) {
      const char c = text_[at_];
      if (c == '"') at_ = std::min(text_.find('"', at_ + 1), end_ - 1);
      const bool ends = depth == 0 && (entry.is_block ? c == '}' : c == ';');
      if (ends) {
        entry.end = at_++;
        return true;
      }
      if (c == '{' || c == '(') ++depth;
      if (c == '}' || c == ')') --depth;
    }
    return false;
  }

  const std::string& text_;
  std::size_t at_, end_;
};

}  // namespace

std::string without_foam_comments(std::string text) {
  for (std::size_t at = text.find('/'); at != std::string::npos; at = text.find('/', at + 1)) {
    const bool line = text.compare(at, 2, "//") == 0, block = text.compare(at, 2, "/*") == 0;
    if (!line && !block) continue;
    const std::size_t found = text.find(line ? "\n" : "*/", at);
    const std::size_t end = found == std::string::npos ? text.size() : found + (line ? 0 : 2);
    std::fill(text.begin() + at, text.begin() + end, ' ');
  }
  return text;
}

std::vector<FoamEntry> foam_entries(const std::string& text, std::size_t begin, std::size_t end) {
  return Entries(text, begin, end).all();
}

std::optional<FoamEntry> foam_entry(const std::vector<FoamEntry>& entries, const std::string& key) {
  const auto found = std::find_if(entries.rbegin(), entries.rend(),
                                  [&](const FoamEntry& entry) { return entry.key == key; });
  if (found == entries.rend()) return std::nullopt;
  return *found;
}

std::string foam_word(const std::string& text, const FoamEntry& entry) {
  const std::string value = text.substr(entry.begin, entry.end - entry.begin);
  const std::size_t begin = std::min(value.find_first_not_of(std::string(blanks) + '"'), value.size());
  const std::size_t end = value.find_first_of(std::string(blanks) + '"', begin);
  return value.substr(begin, end - begin);
}

bool is_foam_true(const std::string& word) {
  constexpr std::string_view words[]{"on", "yes", "true", "y", "t", "compressed"};
  return std::ranges::find(words, word) != std::end(words);
}

}  // namespace quadloop::io
