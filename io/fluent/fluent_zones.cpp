#include "io/fluent/fluent_zones.hpp"

#include <array>
#include <charconv>
#include <limits>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

struct FluentZone {
  const char* condition;
  std::int64_t number;
  const char* word;
};

/// Of each condition the first is what is written.
constexpr std::array<FluentZone, 14> zones{{{"wall", 3, "wall"},
                                            {"farfield", 9, "pressure-far-field"},
                                            {"inflow", 10, "velocity-inlet"},
                                            {"inflow", 4, "pressure-inlet"},
                                            {"inflow", 20, "mass-flow-inlet"},
                                            {"outflow", 5, "pressure-outlet"},
                                            {"outflow", 36, "outflow"},
                                            {"symmetry", 7, "symmetry"},
                                            {"symmetry", 37, "axis"},
                                            {"interface", fluent_interior, "interior"},
                                            {"interface", 24, "interface"},
                                            {"viscous_wall", 3, "wall"},
                                            {"inviscid_wall", 3, "wall"},
                                            {"none", 3, "wall"}}};

const FluentZone& zone_for(const std::string& condition) {
  for (const FluentZone& zone : zones) {
    if (condition == zone.condition) return zone;
  }
  return zones.back();
}

}  // namespace

std::int64_t fluent_number(const std::string& condition) { return zone_for(condition).number; }
std::string fluent_word(const std::string& condition) { return zone_for(condition).word; }

std::string condition_of_fluent(std::int64_t number) {
  for (const FluentZone& zone : zones) {
    if (number == zone.number) return zone.condition;
  }
  return "none";
}

std::string fluent_zone_name(std::int64_t zone, const std::string& word, const std::string& name) {
  return "(45 (" + std::to_string(zone) + " " + word + " " + name + ")())\n";
}

void require_countable_in_fluent(const std::string& path, std::int64_t nodes, std::int64_t cells) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (nodes >= most || cells >= most)
    throw OutputError(path +
                      ": the mesh has more nodes or cells than this format can count (32-bit numbers)");
}

std::string fluent_hexadecimal(std::int64_t number) {
  std::string text(16, '0');
  text.resize(std::to_chars(text.data(), text.data() + text.size(), number, 16).ptr - text.data());
  return text;
}

}  // namespace quadloop
