#include "flow/su2/su2_config.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

#include "mesher/base/error.hpp"
#include "mesher/base/trimmed.hpp"

namespace quadloop::flow {

std::string su2_key(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

std::optional<double> su2_number(const std::string& word) {
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Su2Config::Su2Config(const std::string& text, const std::string& path) {
  std::istringstream input(text);
  int number = 0;
  for (std::string row; std::getline(input, row);) {
    const int first = ++number;
    Line line{row, {}, {}};
    std::string meaning(trimmed(row.substr(0, row.find('%'))));
    while (meaning.ends_with('\\') && std::getline(input, row)) {
      ++number;
      line.text += "\n" + row;
      meaning = trimmed(meaning.substr(0, meaning.size() - 1) + " " + row.substr(0, row.find('%')));
    }
    const std::size_t equals = meaning.find('=');
    const auto refuse = [&](const std::string& fault) {
      throw InputError(path + ":" + std::to_string(first) + ": " + fault);
    };
    if (!meaning.empty() && equals == std::string::npos)
      refuse("expected KEY= value, found '" + meaning.substr(0, 40) + "'");
    if (equals != std::string::npos) {
      line.key = su2_key(std::string(trimmed(std::string_view(meaning).substr(0, equals))));
      line.value = trimmed(std::string_view(meaning).substr(equals + 1));
      if (find(line.key) != nullptr) refuse(line.key + " is there twice");
    }
    lines_.push_back(std::move(line));
  }
}

Su2Config::Line* Su2Config::find(const std::string& key) {
  const auto found = std::ranges::find(lines_, key, &Line::key);
  return found == lines_.end() ? nullptr : &*found;
}

std::optional<std::string> Su2Config::value(const std::string& key) const {
  const auto found = std::ranges::find(lines_, key, &Line::key);
  return found == lines_.end() ? std::nullopt : std::optional(found->value);
}

std::vector<std::string> Su2Config::words(const std::string& key) const {
  std::string text = value(key).value_or("");
  std::ranges::replace_if(
      text, [](char c) { return c == ',' || c == '(' || c == ')'; }, ' ');
  std::istringstream input(text);
  std::vector<std::string> words;
  for (std::string word; input >> word;) words.push_back(word);
  return words;
}

void Su2Config::set(const std::string& key, const std::string& value) {
  const Line line{key + "= " + value, key, value};
  if (Line* const found = find(key)) {
    *found = line;
  } else {
    lines_.push_back(line);
  }
}

std::string Su2Config::text() const {
  std::string text;
  for (const Line& line : lines_) text += line.text + "\n";
  return text;
}

}  // namespace quadloop::flow
