#include "io/input/case_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

#include "io/files/reading/input_file.hpp"
#include "io/text/decimal_comma.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t");
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// KEY=VALUE, with the key split at its dots. A part may be quoted and then contain dots etc.:
/// boundary."a.b=c".spacing. As shells remove quotes, a part without quotes may be a pattern or contain
/// blanks too.
struct Assignment {
  std::vector<std::string> parts{{}};
  std::string value;
  bool has_value = false;
  bool has_slash = false;  ///< unquoted, in the key

  explicit Assignment(std::string_view text) {
    char quote = 0;
    bool was_quoted = false;
    const auto end_part = [&] {
      if (!was_quoted) parts.back() = trimmed(parts.back());
      was_quoted = false;
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
      const char c = text[i];
      if (quote == 0 && c == '=') {
        has_value = true;
        value = text.substr(i + 1);
        break;
      }
      if (quote == 0 && c == '.') {
        end_part();
        parts.emplace_back();
      } else if (c == quote || (quote == 0 && (c == '"' || c == '\''))) {
        if (quote == 0) parts.back() = trimmed(parts.back());
        quote = quote == 0 ? c : '\0';
        was_quoted = true;
      } else if (quote != 0 || !was_quoted || c != ' ') {
        parts.back() += c;
        has_slash = has_slash || (quote == 0 && c == '/');
      }
    }
    end_part();
  }

  bool has_key() const {
    return std::none_of(parts.begin(), parts.end(), [](const std::string& part) { return part.empty(); });
  }
};

/// Parses the value as TOML, else takes it as plain text.
toml::table parse_value(const std::string& text) {
  try {
    toml::table parsed = toml::parse("value = " + text + "\n");
    if (parsed.size() == 1) return parsed;
  } catch (const toml::parse_error&) {  // text without quotes, removed by the shell or never written
  }
  toml::table plain;
  plain.insert("value", text);
  return plain;
}

/// Returns the table that holds the key `part`: the node itself. Throws InputError if it is a list or a
/// single value, or if the key is written as an entry of a list, as in `wake[0]`.
toml::table& table_with(toml::node& node, const std::string& part, const std::string& parent,
                        const std::string& place) {
  if (node.is_array_of_tables())
    throw InputError(fmt::format(
        "{0}: '{1}' is a list of tables; select an entry by its number from 0, as in {1}.0.{2}, or replace "
        "the list, as in --set '{1}=[{{...}}]'",
        place, parent, part));
  if (node.is_array())
    throw InputError(
        fmt::format("{0}: '{1}' is a list; replace it as a whole, as in --set '{1}=[...]'", place, parent));
  toml::table* table = node.as_table();
  if (table == nullptr)
    throw InputError(fmt::format("{}: '{}' is a single value, not a table with '{}'", place, parent, part));
  const std::string list = part.substr(0, part.find('['));
  if (list != part && table->get(part) == nullptr && table->get(list) != nullptr &&
      table->get(list)->is_array())
    throw InputError(
        fmt::format("{0}: '{1}' is no key; select an entry of the list '{2}' by its number from 0, "
                    "as in {2}.0",
                    place, part, list));
  return *table;
}

/// Returns the table or list one level down, created if missing.
toml::node* step_down(toml::node& node, const std::string& part, const std::string& parent,
                      const std::string& place) {
  if (toml::array* list = node.as_array()) {
    std::size_t index = 0;
    const auto [stop, fault] = std::from_chars(part.data(), part.data() + part.size(), index);
    if (fault == std::errc{} && stop == part.data() + part.size() && index < list->size())
      return list->get(index);
    throw InputError(fmt::format("{}: '{}' is not a number from 0 to {}, which selects an entry of the list",
                                 place, part, std::ssize(*list) - 1));
  }
  toml::table& table = table_with(node, part, parent, place);
  if (table.get(part) == nullptr) table.insert(part, toml::table{});
  return table.get(part);
}

/// Returns row `number` of a text, from 1.
std::string row_of(const std::string& text, std::uint32_t number) {
  std::istringstream rows(text);
  std::string row;
  for (std::uint32_t i = 0; i < number && std::getline(rows, row);) ++i;
  return row;
}

/// Returns a hint about a frequent mistake in a row that is not valid TOML: a pattern or a text without
/// quotes, a decimal comma.
std::string hint_for(const std::string& row) {
  const auto begin = row.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  if (row[begin] == '[') {
    const bool bare_pattern =
        row.find_first_of("*?") != std::string::npos && row.find_first_of("\"'") == std::string::npos;
    return bare_pattern ? "; quote it: [boundary.\"*\"]" : "";
  }
  const auto equals = row.find('=', begin);
  const auto value = equals == std::string::npos ? equals : row.find_first_not_of(" \t[", equals + 1);
  if (value == std::string::npos) return "";
  if (const std::string comma = decimal_comma_in(trimmed(row.substr(value, row.find('#', value) - value)));
      !comma.empty())
    return "; " + comma;
  const std::string word = row.substr(value, row.find_first_of(" \t\r,]#", value) - value);
  if (std::isalpha(static_cast<unsigned char>(row[value])) == 0) return "";
  return word == "true" || word == "false" ? "" : "; put text in quotes: \"" + word + "\"";
}

}  // namespace

std::string CaseTable::Data::place(const std::string& path, const toml::node* node) const {
  for (std::string prefix = path; !prefix.empty();) {
    const auto found = assigned.find(prefix);
    if (found != assigned.end()) return "--set " + found->second;
    const auto dot = prefix.rfind('.');
    prefix.resize(dot == std::string::npos ? 0 : dot);
  }
  const auto below = assigned.lower_bound(path + ".");  // a table that exists only by an assignment
  const auto line = node == nullptr ? 0 : node->source().begin.line;
  if (line == 0 && below != assigned.end() && below->first.starts_with(path + "."))
    return "--set " + below->second;
  return line == 0 || !has_lines ? file : fmt::format("{}:{}", file, line);
}

void parse_case(CaseTable::Data& data, const CaseSource& source) {
  const std::string& path = source.path;
  data.file = path;
  data.has_lines = !source.text;
  const std::string text = source.text ? *source.text : read_input(path);
  try {
    data.root = toml::parse(text);
  } catch (const toml::parse_error& error) {
    std::string what(error.description());
    for (char& c : what) c = c == '\n' ? ' ' : c;
    const toml::source_position at = error.source().begin;
    throw InputError(fmt::format("{}:{}: {}; correct this line (column {}){}", path, at.line, what, at.column,
                                 hint_for(row_of(text, at.line))));
  }
}

bool is_assignment(std::string_view word) {
  const Assignment assignment(word);
  return assignment.has_value && assignment.has_key() && !assignment.has_slash && !word.starts_with('-');
}

void assign(CaseTable::Data& data, const std::string& text) {
  const std::string place = "--set " + text;
  const Assignment assignment(text);
  const std::vector<std::string>& parts = assignment.parts;
  if (!assignment.has_value) throw InputError(place + ": has no '='; write as in spacing.min=0.1");
  if (!assignment.has_key())
    throw InputError(place + ": what stands before the '=' is not a key; write as in spacing.min=0.1");
  toml::node* node = &data.root;
  std::string parent;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    node = step_down(*node, parts[i], parent, place);
    parent += (i == 0 ? "" : ".") + parts[i];
  }
  toml::table& table = table_with(*node, parts.back(), parent, place);
  const toml::table parsed = parse_value(assignment.value);
  parsed.get("value")->visit([&](const auto& value) { table.insert_or_assign(parts.back(), value); });
  data.assigned[fmt::format("{}", fmt::join(parts, "."))] = text;
}

}  // namespace quadloop::io
