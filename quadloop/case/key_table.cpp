#include "quadloop/case/key_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "mesher/base/error.hpp"
#include "mesher/base/json.hpp"
#include "mesher/base/nearest_word.hpp"
#include "quadloop/case/case_keys.hpp"

namespace quadloop {

using io::CaseTable;

namespace {

std::string text_of(const io::Range& range) {
  const std::string text = range.text();
  return text == "finite" ? "" : ", " + text;
}

/// Returns a number inside the range that is neither a limit nor a usual default.
double inside(const io::Range& range) {
  const double low = std::isfinite(range.low) ? range.low : 0;
  return std::isfinite(range.high) ? low + 0.3 * (range.high - low) : low + 3;
}

/// A key of the table itself or, by its dotted name, of another one.
class NamedKey {
 public:
  NamedKey(const std::string& name, const CaseTable& table, const TableText& text)
      : table_{table}, text_{&text}, key_{name} {
    const auto dot = name.find('.');
    if (dot == std::string::npos) return;
    key_ = name.substr(dot + 1);
    text_ = &*std::ranges::find(case_tables(), name.substr(0, dot), &TableText::name);
    table_ = table.root().table(text_->name);
  }

  bool is_given() const { return table_ && table_->has(key_); }
  /// As JSON; empty if the key is not given and has no default.
  std::string value() const {
    return is_given() ? table_->json(key_) : std::ranges::find(text_->keys, key_, &KeyText::name)->initial;
  }

 private:
  std::optional<CaseTable> table_;
  const TableText* text_;
  std::string key_;
};

/// A condition without " or ".
struct Condition {
  std::string name, sign, value;  ///< the sign is one of "", "no", "=", "<", ">"

  explicit Condition(const std::string& text) {
    const auto blank = text.find(' ');
    name = text.substr(0, blank);
    if (blank == std::string::npos) return;
    const std::string rest = text.substr(blank + 1);
    sign = name == "no" ? "no" : rest.substr(0, 1);
    if (sign == "no")
      name = rest;
    else
      value = rest.substr(2);
  }

  bool holds(const NamedKey& key) const {
    if (sign.empty() || sign == "no") return key.is_given() == sign.empty();
    if (sign == "=") return key.value() == value;
    const double number = std::atof(key.value().c_str()), bound = std::atof(value.c_str());
    return sign == "<" ? number < bound : number > bound;
  }
};

std::vector<Condition> alternatives_of(const std::string& text) {
  constexpr std::string_view between = " or ";
  std::vector<Condition> conditions;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(between, begin), text.size());
    conditions.emplace_back(text.substr(begin, end - begin));
    begin = end + between.size();
  }
  return conditions;
}

bool holds(const std::string& text, const CaseTable& table, const TableText& keys) {
  const std::vector<Condition> conditions = alternatives_of(text);
  return conditions.empty() || std::ranges::any_of(conditions, [&](const Condition& condition) {
           return condition.holds(NamedKey(condition.name, table, keys));
         });
}

/// Returns the error for a key whose requirement is not met.
std::string fault_without(const KeyNeed& need, const CaseTable& table, const TableText& keys) {
  const Condition first = alternatives_of(need.condition).front();
  const std::string remedy = need.remedy.empty() ? "" : "; " + need.remedy;
  if (first.sign == "no")
    return fmt::format("stands beside {}{}", first.name, remedy.empty() ? "; give one of them" : remedy);
  const std::string value = first.sign.empty() ? "" : NamedKey(first.name, table, keys).value();
  return fmt::format("needs {}{}{}", need.condition,
                     value.empty() ? "" : fmt::format(", but {} = {}", first.name, value), remedy);
}

/// Returns a hint: a key of another table with this name.
std::string guess_elsewhere(const std::string& key) {
  for (const TableText& table : case_tables()) {
    if (!table.name.empty() && std::ranges::count(table.keys, key, &KeyText::name) > 0)
      return fmt::format("; do you mean '{}.{}'?", table.name, key);
  }
  return "";
}

}  // namespace

std::string words_in_text(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "`" : i + 1 == words.size() ? " or `" : ", `") + words[i] + "`";
  return text;
}

ValueForm<double> number(const io::Range& range) {
  return {"number" + text_of(range), fmt::format("{}", inside(range)),
          [range](const CaseTable& table, const std::string& key) { return *table.number(key, range); },
          [](double value) { return json_of(value); }};
}

ValueForm<std::int64_t> whole(const io::Range& range) {
  return {"whole number" + text_of(range), fmt::format("{}", std::ceil(inside(range))),
          [range](const CaseTable& table, const std::string& key) { return *table.whole(key, range); },
          [](std::int64_t value) { return json_of(value); }};
}

ValueForm<bool> flag() {
  return {words_in_text({"true", "false"}), "true",
          [](const CaseTable& table, const std::string& key) { return *table.flag(key); },
          [](bool value) { return fmt::format("{}", value); }};
}

ValueForm<std::string> text() {
  return {"text", "\"text\"", [](const CaseTable& table, const std::string& key) { return *table.text(key); },
          [](const std::string& value) { return value.empty() ? "" : json_of(value); }};
}

ValueForm<std::vector<std::string>> texts(const std::vector<std::string>& words) {
  const auto read = [words](const CaseTable& table, const std::string& key) {
    const std::vector<std::string> values = table.texts(key);
    for (const std::string& value : values) {
      if (!words.empty()) table.known_word(key, value, words);
    }
    return values;
  };
  return {"text, or a list", json_of(words.empty() ? "text" : words.back()), read,
          [](const std::vector<std::string>& values) { return values.empty() ? "" : json_of(values); }};
}

ValueForm<Point> point() {
  return {"`[x, y]`", "[3, 4]", [](const CaseTable& table, const std::string& key) {
            const std::vector<double> values = *table.numbers(key, 2);
            return Point{values[0], values[1]};
          }};
}

ValueForm<std::vector<Point>> points() {
  return {"`[x, y]`, or a list", "[3, 4]", [](const CaseTable& table, const std::string& key) {
            std::vector<Point> points;
            for (const auto& pair : table.pairs(key)) points.push_back({pair[0], pair[1]});
            return points;
          }};
}

ValueForm<std::vector<double>> numbers(const std::string& text, const std::string& example, std::size_t count,
                                       const std::string& wanted,
                                       bool (*is_good)(const std::vector<double>&)) {
  return {text, example, [=](const CaseTable& table, const std::string& key) {
            const std::vector<double> values = *table.numbers(key, count, {-1e100, 1e100});
            if (!is_good(values))
              table.refuse(key, fmt::format("is {}, but must be {}", table.json(key), wanted));
            return values;
          }};
}

ValueForm<std::vector<double>> box() {
  return numbers("`[x0, x1, y0, y1]`", "[0, 1, 2, 3]", 4, "[x0, x1, y0, y1] with x0 < x1 and y0 < y1",
                 [](const std::vector<double>& b) { return b[0] < b[1] && b[2] < b[3]; });
}

ValueForm<std::string> boundary_name() {
  return {"text", "\"wing\"", [](const CaseTable& table, const std::string& key) {
            const std::string name = *table.text(key);
            const bool is_word =
                std::ranges::all_of(name, [](unsigned char c) { return c > ' ' && c != 127; });
            if (name.empty() || name.front() == '#' || !is_word)
              table.refuse(key, "is no name for a boundary; give one word without blanks");
            return name;
          }};
}

void refuse_unknown_keys(const CaseTable& table, const std::vector<std::string>& names) {
  for (const std::string& key : table.keys()) {
    if (std::ranges::count(names, key) > 0) continue;
    const std::string guess = guess_for(key, names);
    throw InputError(fmt::format("{}: unknown key '{}'; known here: {}{}", table.place(key),
                                 table.full_name(key), fmt::join(names, ", "),
                                 guess.empty() ? guess_elsewhere(key) : guess));
  }
}

void require_needs(const CaseTable& table, const TableText& keys) {
  for (const KeyText& key : keys.keys) {
    if (!table.has(key.name)) {
      for (const KeyRequired& required : key.required) {
        if (holds(required.when, table, keys)) table.refuse(key.name, "is missing: " + required.what);
      }
      continue;
    }
    for (const KeyNeed& need : key.needs) {
      if (!holds(need.when, table, keys) || holds(need.condition, table, keys)) continue;
      const std::string fault = fault_without(need, table, keys);
      if (!need.warns) table.refuse(key.name, fault);
      table.warn(key.name, "does nothing: it " + fault);
    }
  }
}

}  // namespace quadloop
