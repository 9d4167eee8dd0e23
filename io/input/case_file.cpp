#include "io/input/case_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "io/input/case_data.hpp"
#include "io/text/decimal_comma.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"

namespace quadloop::io {

namespace {

const toml::table& as_table(const void* table) { return *static_cast<const toml::table*>(table); }

/// Returns the type of the user's value, for messages.
std::string kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table: return "a table";
    case toml::node_type::array: return "a list";
    case toml::node_type::string: return "a text";
    case toml::node_type::integer: return "a whole number";
    case toml::node_type::floating_point: return "a number";
    case toml::node_type::boolean: return "true or false";
    default: return "a date or time";
  }
}

std::string join(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

/// Returns a floating-point or integer value; empty for other types.
std::optional<double> number_in(const toml::node& node) {
  if (const auto* whole = node.as_integer()) return static_cast<double>(whole->get());
  if (const auto* number = node.as_floating_point()) return number->get();
  return std::nullopt;
}

/// Returns a value as JSON on one line; 1 and 1.0 are equal.
std::string json_of(const toml::node& node) {
  if (const auto number = number_in(node)) return fmt::format("{}", *number);
  std::vector<std::string> parts;
  if (const toml::array* list = node.as_array()) {
    for (const toml::node& value : *list) parts.push_back(json_of(value));
    return "[" + join(parts) + "]";
  }
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table)
      parts.push_back(json_of(toml::value<std::string>(std::string(key.str()))) + ": " + json_of(value));
    return "{" + join(parts) + "}";
  }
  std::ostringstream text;
  node.visit([&](const auto& value) { text << toml::json_formatter(value); });
  return text.str();
}

void append_values(const toml::table& table, const std::string& above,
                   const std::vector<std::string>& without,
                   std::vector<std::pair<std::string, std::string>>& result) {
  for (const auto& [key, node] : table) {
    const std::string name = above + std::string(key.str());
    if (std::find(without.begin(), without.end(), name) != without.end()) continue;
    if (const toml::table* below = node.as_table())
      append_values(*below, name + ".", without, result);
    else
      result.emplace_back(name, json_of(node));
  }
}

}  // namespace

bool Range::contains(double value) const {
  return std::isfinite(value) && (low_open ? value > low : value >= low) &&
         (high_open ? value < high : value <= high);
}

std::string Range::text() const {
  std::string text;
  if (std::isfinite(low)) text = fmt::format("{} {}", low_open ? "above" : "at least", low);
  if (std::isfinite(high))
    text += fmt::format("{}{} {}", text.empty() ? "" : " and ", high_open ? "below" : "at most", high);
  return text.empty() ? "finite" : text;
}

/// Lookup of a key, with the common error messages.
class Lookup {
 public:
  Lookup(const CaseTable& table, const std::string& key, const Range& range = {})
      : table_{table}, key_{key}, range_{range} {}

  double number(const toml::node& node) const {
    const auto value = number_in(node);
    if (!value) refuse("a number", node);
    if (!range_.contains(*value)) {
      const bool is_endless = std::isinf(*value) && std::isfinite(range_.low);
      table_.refuse(key_, fmt::format("is {}, but must be {}{}", *value, range_.text(),
                                      is_endless ? " and finite" : ""));
    }
    return *value;
  }
  std::string text(const toml::node& node) const {
    if (!node.is_string()) refuse("a text in quotes", node);
    return *node.value<std::string>();
  }
  const toml::array& list(const toml::node& node, const std::string& of_what) const {
    if (!node.is_array()) refuse(of_what, node);
    return *node.as_array();
  }
  std::vector<double> numbers(const toml::node& node, std::size_t count) const {
    const std::string wanted = fmt::format("a list of {} numbers", count);
    const toml::array& values = list(node, wanted);
    if (values.size() != count)
      table_.refuse(key_, fmt::format("is a list of {}, but must be {}", values.size(), wanted));
    std::vector<double> result;
    for (const toml::node& value : values) result.push_back(number(value));
    return result;
  }
  [[noreturn]] void refuse(const std::string& wanted, const toml::node& node) const {
    const std::string comma = node.is_string() ? decimal_comma_in(*node.value<std::string>()) : "";
    table_.refuse(
        key_, fmt::format("must be {}, not {}{}", wanted, kind_of(node), comma.empty() ? "" : "; " + comma));
  }

 private:
  const CaseTable& table_;
  const std::string& key_;
  Range range_;
};

CaseTable::CaseTable(std::shared_ptr<Data> data, const void* table, std::string path)
    : data_{std::move(data)}, table_{table}, path_{std::move(path)} {}

CaseTable CaseTable::root() const { return {data_, &data_->root, ""}; }

bool CaseTable::has(const std::string& key) const { return as_table(table_).contains(key); }

std::optional<double> CaseTable::number(const std::string& key, const Range& range) const {
  if (!has(key)) return std::nullopt;
  return Lookup(*this, key, range).number(*as_table(table_).get(key));
}

std::optional<std::int64_t> CaseTable::whole(const std::string& key, const Range& range) const {
  const auto value = number(key, range);
  if (!value) return std::nullopt;
  if (*value != std::floor(*value)) refuse(key, fmt::format("must be a whole number, not {}", *value));
  return static_cast<std::int64_t>(*value);
}

std::optional<std::string> CaseTable::text(const std::string& key) const {
  if (!has(key)) return std::nullopt;
  return Lookup(*this, key).text(*as_table(table_).get(key));
}

std::optional<bool> CaseTable::flag(const std::string& key) const {
  if (!has(key)) return std::nullopt;
  const std::optional<bool> value = as_table(table_).get(key)->value_exact<bool>();
  if (!value) refuse(key, "must be true or false");
  return value;
}

std::string CaseTable::known_word(const std::string& key, const std::string& word,
                                  const std::vector<std::string>& words) const {
  if (std::ranges::find(words, word) != words.end()) return word;
  refuse(key, fmt::format("is '{}', but must be one of: {}{}", word, join(words), guess_for(word, words)));
}

std::optional<std::vector<double>> CaseTable::numbers(const std::string& key, std::size_t count,
                                                      const Range& range) const {
  if (!has(key)) return std::nullopt;
  return Lookup(*this, key, range).numbers(*as_table(table_).get(key), count);
}

std::vector<std::string> CaseTable::texts(const std::string& key) const {
  if (!has(key)) return {};
  const Lookup lookup(*this, key);
  const toml::node& node = *as_table(table_).get(key);
  if (node.is_string()) return {lookup.text(node)};
  std::vector<std::string> result;
  for (const toml::node& value : lookup.list(node, "a text in quotes or a list of them"))
    result.push_back(lookup.text(value));
  return result;
}

std::vector<double> CaseTable::numbers_or_one(const std::string& key, const Range& range) const {
  if (!has(key)) return {};
  const Lookup lookup(*this, key, range);
  const toml::node& node = *as_table(table_).get(key);
  if (node.is_number()) return {lookup.number(node)};
  std::vector<double> result;
  for (const toml::node& value : lookup.list(node, "a number or a list of them"))
    result.push_back(lookup.number(value));
  return result;
}

std::vector<std::vector<double>> CaseTable::pairs(const std::string& key) const {
  if (!has(key)) return {};
  const Lookup lookup(*this, key);
  const toml::node& node = *as_table(table_).get(key);
  const toml::array& values = lookup.list(node, "a pair [x, y] or a list of them");
  if (values.empty() || !values.get(0)->is_array()) return {lookup.numbers(node, 2)};
  std::vector<std::vector<double>> result;
  for (const toml::node& value : values) result.push_back(lookup.numbers(value, 2));
  return result;
}

bool CaseTable::is_table(const std::string& key) const {
  return has(key) && as_table(table_).get(key)->is_table();
}

bool CaseTable::is_text(const std::string& key) const {
  return has(key) && as_table(table_).get(key)->is_string();
}

std::string CaseTable::json(const std::string& key) const { return json_of(*as_table(table_).get(key)); }

std::vector<std::pair<std::string, std::string>> CaseTable::values(
    const std::vector<std::string>& without) const {
  std::vector<std::pair<std::string, std::string>> result;
  append_values(as_table(table_), "", without, result);
  return result;
}

std::optional<CaseTable> CaseTable::table(const std::string& key) const {
  if (!has(key)) return std::nullopt;
  const toml::node& node = *as_table(table_).get(key);
  if (!node.is_table()) Lookup(*this, key).refuse("a table [" + full_name(key) + "]", node);
  return CaseTable(data_, node.as_table(), full_name(key));
}

std::vector<CaseTable> CaseTable::tables(const std::string& key) const {
  if (!has(key)) return {};
  const Lookup lookup(*this, key);
  std::vector<CaseTable> result;
  const std::string wanted = "a list of tables, each begun by [[" + full_name(key) + "]]";
  const toml::node& node = *as_table(table_).get(key);
  if (node.is_table() && node.source().begin.line == 0) {  // created by an assignment to key.0.x
    refuse(key, "has nothing in the case file that --set could change; write a [[" + full_name(key) +
                    "]] there first (the first is number 0)");
  }
  for (const toml::node& value : lookup.list(node, wanted)) {
    if (!value.is_table()) lookup.refuse(wanted, value);
    result.emplace_back(data_, value.as_table(), fmt::format("{}.{}", full_name(key), result.size()));
  }
  return result;
}

std::vector<std::string> CaseTable::keys() const {
  std::vector<std::pair<std::uint64_t, std::string>> by_line;  // toml++ stores keys in alphabetical order
  for (const auto& [key, node] : as_table(table_)) {
    const auto line = node.source().begin.line;
    by_line.emplace_back(line == 0 ? std::numeric_limits<std::uint64_t>::max() : line,
                         std::string(key.str()));
  }
  std::stable_sort(by_line.begin(), by_line.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> names;
  for (auto& entry : by_line) names.push_back(std::move(entry.second));
  return names;
}

std::string CaseTable::place(const std::string& key) const {
  const toml::node* node = as_table(table_).get(key);
  return node == nullptr ? place() : data_->place(full_name(key), node);
}

std::string CaseTable::place() const { return data_->place(path_, &as_table(table_)); }

std::string CaseTable::full_name(const std::string& key) const {
  return path_.empty() ? key : path_ + "." + key;
}

void CaseTable::warn(const std::string& key, const std::string& message) const {
  data_->warnings.push_back(fmt::format("{}: '{}' {}", place(key), full_name(key), message));
}

const std::vector<std::string>& CaseTable::warnings() const { return data_->warnings; }

void CaseTable::refuse(const std::string& key, const std::string& message) const {
  throw InputError(fmt::format("{}: '{}' {}", place(key), full_name(key), message));
}

CaseTable read_case(const CaseSource& source, const std::vector<std::string>& assignments) {
  auto data = std::make_shared<CaseTable::Data>();
  parse_case(*data, source);
  for (const std::string& assignment : assignments) assign(*data, assignment);
  const toml::table* root = &data->root;
  return CaseTable(std::move(data), root, "");
}

}  // namespace quadloop::io
