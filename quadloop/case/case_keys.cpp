#include "quadloop/case/case_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <regex>

#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"
#include "quadloop/case/adapt_settings.hpp"
#include "quadloop/case/flow_settings.hpp"
#include "quadloop/case/layer_settings.hpp"
#include "quadloop/case/mesh_settings.hpp"
#include "quadloop/case/pair_settings.hpp"
#include "quadloop/case/shape_settings.hpp"
#include "quadloop/case/smooth_settings.hpp"

namespace quadloop {

namespace {

/// Returns the default in Markdown; empty for a key without one.
std::string default_of(const KeyText& key) {
  if (!key.fallback.empty()) return key.fallback;
  return key.required.empty() && !key.initial.empty() ? "`" + key.initial + "`" : "";
}

/// "number, above 0, in degrees".
std::string form_of(const KeyText& key) {
  return key.unit.empty() ? key.value : fmt::format("{} ({})", key.value, key.unit);
}

/// Whether one of two keys must be given, and only one: the key is required without the other one.
bool is_one_of_two(const KeyText& key, const KeyNeed& need) {
  return need.when.empty() &&
         std::ranges::any_of(key.required, [&](const KeyRequired& r) { return r.when == need.condition; });
}

/// Returns the meaning of the key and its requirements.
std::string sentences_of(const KeyText& key) {
  std::string text = key.meaning;
  std::string other;  // "no NAME" of the key that is given instead of this one
  for (const KeyNeed& need : key.needs) {
    if (need.condition.starts_with("no ") && is_one_of_two(key, need)) {
      other = need.condition;
      text += fmt::format(" Give either this key or `{}`.", other.substr(3));
      continue;
    }
    const bool excludes = need.condition.starts_with("no ");
    const std::string subject = need.when.empty() ? "" : fmt::format("With `{}`: ", need.when);
    text += excludes ? fmt::format(" {}Not with `{}`.", subject, need.condition.substr(3))
                     : fmt::format(" {}{} `{}`.", subject, need.warns ? "Only with" : "Requires",
                                   std::regex_replace(need.condition, std::regex(" or "), "` or `"));
  }
  for (const KeyRequired& required : key.required) {
    if (!other.empty() && required.when == other) continue;
    text += required.when.empty() ? " Required."
            : required.when.starts_with("no ")
                ? fmt::format(" Required without `{}`.", required.when.substr(3))
                : fmt::format(" Required with `{}`.", required.when);
  }
  return text;
}

/// Converts Markdown to plain text, without link targets and backticks.
std::string plain(const std::string& markdown) {
  const std::string text =
      std::regex_replace(markdown, std::regex(R"(\[((?:\[[^\]]*\]|[^\]])*)\]\([^)]*\))"), "$1");
  return std::regex_replace(text, std::regex("`"), "");
}

std::string dotted(const TableText& table, const KeyText& key) {
  return table.name.empty() ? key.name : table.name + "." + key.name;
}

/// Wraps at 80 characters, indented.
std::string wrapped(const std::string& text) {
  constexpr std::size_t width = 80;
  std::string result, line;
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    if (line.size() + end - begin > width) result += line + "\n", line.clear();
    line += (line.empty() ? "    " : " ") + text.substr(begin, end - begin);
    begin = end + 1;
  }
  return result + line + "\n";
}

std::string full_help(const TableText& table, const KeyText& key) {
  const std::string usual = default_of(key);
  return fmt::format("{}: {}{}\n{}", dotted(table, key), plain(form_of(key)),
                     usual.empty() ? "" : "; default: " + plain(usual), wrapped(plain(sentences_of(key))));
}

/// Returns a line for each key, with the first sentence of its meaning.
std::string list_of(const TableText& table) {
  std::string text;
  for (const KeyText& key : table.keys) text += fmt::format("  {:<20} {}\n", key.name, plain(form_of(key)));
  return text;
}

/// Returns the name in the table: without the numbers of [[source]] etc., and with NAME for that of a
/// boundary.
std::string general_name(const std::string& topic) {
  const std::string name = std::regex_replace(topic, std::regex(R"(\.\d+(?=\.|$)|[\[\]])"), "");
  for (const TableText& table : {layer_keys().text(), boundary_keys().text()}) {
    const std::string pattern = std::regex_replace(table.name, std::regex("NAME"), ".+");
    for (const KeyText& key : table.keys) {
      if (std::regex_match(name, std::regex(pattern + "\\." + key.name))) return dotted(table, key);
    }
    if (std::regex_match(name, std::regex(pattern))) return table.name;
  }
  return name;
}

}  // namespace

const std::vector<TableText>& case_tables() {
  static const std::vector<TableText> tables{
      title_keys().text(), geometry_keys().text(),   far_field_keys().text(), shape_keys().text(),
      pair_keys().text(),  spacing_keys().text(),    boundary_keys().text(),  layer_keys().text(),
      wake_keys().text(),  layer_line_keys().text(), flow_keys().text(),      source_keys().text(),
      block_keys().text(), line_keys().text(),       mesh_keys().text(),      smooth_keys().text(),
      adapt_keys().text(), until_keys().text(),      design_keys().text(),    solver_keys().text(),
      output_keys().text()};
  return tables;
}

std::vector<std::string> root_names() {
  std::vector<std::string> names;
  for (const KeyText& key : case_tables().front().keys) names.push_back(key.name);
  for (const TableText& table : case_tables()) {
    const std::string name = table.name.substr(0, table.name.find('.'));
    if (!name.empty() && std::ranges::count(names, name) == 0) names.push_back(name);
  }
  return names;
}

std::string key_help(const std::string& topic) {
  const std::string name = general_name(topic);
  std::vector<std::string> known;
  std::string text;
  for (const TableText& table : case_tables()) {
    if (!table.name.empty()) known.push_back(table.name);
    if (topic.empty() || table.name == name || table.name.starts_with(name + "."))
      text += (table.name.empty() ? "" : fmt::format("[{}]\n", table.name)) + list_of(table);
    for (const KeyText& key : table.keys) {
      known.push_back(dotted(table, key));
      if (known.back() == name || key.name == name) text += full_help(table, key);
    }
  }
  if (!text.empty()) return text;
  std::string guess = guess_for(name, known);
  for (const TableText& table : case_tables()) {
    for (const KeyText& key : table.keys) {
      if (guess.empty() && !nearest_word(name, {key.name}).empty())
        guess = fmt::format("; do you mean '{}'?", dotted(table, key));
    }
  }
  throw UsageError(
      fmt::format("'{}' is no key and no table of a case file{} 'quadloop help', or 'quadloop COMMAND "
                  "--help' for a command",
                  topic, guess.empty() ? "; see" : guess + " See"));
}

std::string key_reference() {
  std::string text;
  for (const TableText& table : case_tables()) {
    text +=
        fmt::format("<!-- keys of {} -->\n| key | value | default | meaning |\n| --- | --- | --- | --- |\n",
                    table.name.empty() ? "the file" : table.name);
    for (const KeyText& key : table.keys)
      text += fmt::format("| `{}` | {} | {} | {} |\n", key.name, form_of(key), default_of(key),
                          sentences_of(key));
    text += "\n";
  }
  return text;
}

}  // namespace quadloop
