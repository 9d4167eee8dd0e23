#include "io/fluent/fluent_zones.hpp"

#include <array>
#include <charconv>
#include <limits>

#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

struct FluentZone {
  BoundaryCondition condition;
  std::int64_t number;
  const char* word;
};

/// For each condition the first entry is written.
constexpr std::array<FluentZone, 14> zones{{{BoundaryCondition::wall, 3, "wall"},
                                            {BoundaryCondition::farfield, 9, "pressure-far-field"},
                                            {BoundaryCondition::inflow, 10, "velocity-inlet"},
                                            {BoundaryCondition::inflow, 4, "pressure-inlet"},
                                            {BoundaryCondition::inflow, 20, "mass-flow-inlet"},
                                            {BoundaryCondition::outflow, 5, "pressure-outlet"},
                                            {BoundaryCondition::outflow, 36, "outflow"},
                                            {BoundaryCondition::symmetry, 7, "symmetry"},
                                            {BoundaryCondition::symmetry, 37, "axis"},
                                            {BoundaryCondition::interface, 24, "interface"},
                                            {BoundaryCondition::interface, fluent_interior, "interior"},
                                            {BoundaryCondition::viscous_wall, 3, "wall"},
                                            {BoundaryCondition::inviscid_wall, 3, "wall"},
                                            {BoundaryCondition::none, 3, "wall"}}};

const FluentZone& zone_for(BoundaryCondition condition) {
  for (const FluentZone& zone : zones) {
    if (condition == zone.condition) return zone;
  }
  return zones.back();
}

}  // namespace

std::int64_t fluent_number(BoundaryCondition condition) { return zone_for(condition).number; }
std::string fluent_word(BoundaryCondition condition) { return zone_for(condition).word; }

BoundaryCondition condition_of_fluent(std::int64_t number) {
  for (const FluentZone& zone : zones) {
    if (number == zone.number) return zone.condition;
  }
  return BoundaryCondition::none;
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

}  // namespace quadloop::io
