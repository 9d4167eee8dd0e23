#include "adapt/record.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>

namespace quadloop {

namespace {

constexpr const char* settings_begin = "  \"case\": {";
constexpr const char* settings_end = "  },";

/// JSON has no infinities.
std::string number(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < ' ')
      result += fmt::format("\\u{:04x}", static_cast<int>(c));
    else
      result += c;
  }
  return result + "\"";
}

std::string object(const std::vector<std::pair<std::string, double>>& members) {
  std::string text;
  for (const auto& [name, value] : members) text += (text.empty() ? "" : ", ") + quoted(name) + ": " + number(value);
  return "{" + text + "}";
}

/// A member a line, so that it is read back without a parser of JSON.
std::string settings_text(const CaseSettings& settings) {
  std::string text;
  for (const auto& [key, value] : settings) text += (text.empty() ? "\n    " : ",\n    ") + quoted(key) + ": " + value;
  return std::string(settings_begin) + text + "\n" + settings_end + "\n";
}

std::optional<std::uint64_t> digest_in(const std::string& json, const std::string& name) {
  const std::string begin = "\n  \"" + name + "\": \"";
  const std::size_t at = json.find(begin);
  if (at == std::string::npos) return {};
  std::uint64_t digest = 0;
  const char* first = json.data() + at + begin.size();
  const auto [end, fault] = std::from_chars(first, json.data() + json.size(), digest, 16);
  if (fault != std::errc{} || end - first != 16) return {};
  return digest;
}

/// The text between the quotes that quoted() put there.
std::string unquoted(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\\' && i + 1 < text.size()) ++i;
    result += text[i];
  }
  return result;
}

CaseSettings settings_in(const std::string& json) {
  CaseSettings settings;
  std::istringstream lines(json);
  std::string line;
  while (std::getline(lines, line) && line != settings_begin) {
  }
  while (std::getline(lines, line) && line != settings_end) {
    const std::size_t begin = line.find('"'), end = line.find("\": ");
    if (begin == std::string::npos || end == std::string::npos || end <= begin) continue;
    std::string value = line.substr(end + 3);
    if (value.ends_with(',')) value.pop_back();
    settings.emplace_back(unquoted(std::string_view(line).substr(begin + 1, end - begin - 1)), value);
  }
  return settings;
}

}  // namespace

std::string json_text(const CycleRecord& record) {
  std::string text = "{\n";
  const auto member = [&](const char* name, const std::string& value) { text += fmt::format("  \"{}\": {},\n", name, value); };
  member("cycle", std::to_string(record.cycle));
  member("case_digest", fmt::format("\"{:016x}\"", record.case_digest));
  member("geometry_digest", fmt::format("\"{:016x}\"", record.geometry_digest));
  member("nodes", std::to_string(record.nodes));
  member("triangles", std::to_string(record.triangles));
  member("quads", std::to_string(record.quads));
  member("leaves", std::to_string(record.leaves));
  member("worst_angle", number(record.worst_angle));
  member("indicator", object({{"mean", record.mean}, {"deviation", record.deviation}}));
  member("refined", std::to_string(record.refined));
  member("coarsened", std::to_string(record.coarsened));
  member("outside", std::to_string(record.outside));
  member("drift", object(record.drift));
  for (const auto& [name, value] : {std::pair{"cl", record.cl}, {"cd", record.cd}, {"residual", record.residual}}) {
    if (value) member(name, number(*value));
  }
  text += settings_text(record.settings);
  return text + "  \"seconds\": " + object(record.seconds) + "\n}\n";
}

std::optional<RecordedCase> recorded_case(const std::string& json) {
  const auto of_case = digest_in(json, "case_digest"), of_geometry = digest_in(json, "geometry_digest");
  if (!of_case || !of_geometry || !json.ends_with("}\n}\n")) return {};
  return RecordedCase{*of_case, *of_geometry, settings_in(json)};
}

}  // namespace quadloop
