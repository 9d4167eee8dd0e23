#include "io/text/clean_names.hpp"

#include <fmt/format.h>

#include <map>

#include "io/text/name_index.hpp"
#include "mesher/base/utf8.hpp"

namespace quadloop::io {

namespace {

std::string cleaned(const std::string& name) {
  std::string result;
  const std::string text = as_utf8(name);
  for (std::string_view rest = text; !rest.empty(); rest.remove_prefix(utf8_length(rest))) {
    const std::string_view character = rest.substr(0, utf8_length(rest));
    result += is_control_character(character) ? "_" : character;
  }
  return result;
}

}  // namespace

std::vector<std::string> clean_names(std::span<std::string* const> names, const std::string& where) {
  DistinctNames distinct;
  std::map<std::string, std::string> changed;
  for (const std::string* name : names) {
    if (cleaned(*name) == *name)
      distinct.reserve(*name);
    else
      changed.try_emplace(*name);
  }
  if (changed.empty()) return {};
  for (auto& [name, result] : changed) {
    const std::string wanted = cleaned(name);
    result = distinct.name(wanted, [&](const std::string& suffix) { return wanted + suffix; });
  }
  for (std::string* name : names) {
    if (const auto found = changed.find(*name); found != changed.end()) *name = found->second;
  }
  return {fmt::format(
      "{}: {} not in UTF-8, or with control characters: read as Latin-1, with '_' for each control "
      "character; the first is '{}'",
      where, changed.size() == 1 ? "1 name is" : fmt::format("{} names are", changed.size()),
      changed.begin()->second)};
}

}  // namespace quadloop::io
