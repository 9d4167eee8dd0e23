#include "adapt/record.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace quadloop {

namespace {

constexpr const char* digest_key = "\"case_digest\": \"";

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

}  // namespace

std::string json_text(const CycleRecord& record) {
  std::string text = "{\n";
  const auto member = [&](const char* name, const std::string& value) { text += fmt::format("  \"{}\": {},\n", name, value); };
  member("cycle", std::to_string(record.cycle));
  text += fmt::format("  {}{:016x}\",\n", digest_key, record.case_digest);
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
  return text + "  \"seconds\": " + object(record.seconds) + "\n}\n";
}

std::optional<std::uint64_t> case_digest_in(const std::string& json) {
  const std::string key = digest_key;
  const std::size_t at = json.find(key);
  if (at == std::string::npos) return {};
  std::uint64_t digest = 0;
  const char* begin = json.data() + at + key.size();
  const auto [end, fault] = std::from_chars(begin, json.data() + json.size(), digest, 16);
  if (fault != std::errc{} || end - begin != 16) return {};
  return digest;
}

}  // namespace quadloop
