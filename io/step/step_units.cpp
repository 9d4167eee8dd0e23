#include "io/step/step_units.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "io/text/length_units.hpp"
#include "mesher/base/suffix.hpp"

namespace quadloop::io {

namespace {

double factor_of(std::string_view prefix, const StepEntity& unit) {
  constexpr std::array<std::pair<std::string_view, double>, 17> prefixes{{{"", 1},
                                                                          {"EXA", 1e18},
                                                                          {"PETA", 1e15},
                                                                          {"TERA", 1e12},
                                                                          {"GIGA", 1e9},
                                                                          {"MEGA", 1e6},
                                                                          {"KILO", 1e3},
                                                                          {"HECTO", 1e2},
                                                                          {"DECA", 10},
                                                                          {"DECI", 0.1},
                                                                          {"CENTI", 1e-2},
                                                                          {"MILLI", 1e-3},
                                                                          {"MICRO", 1e-6},
                                                                          {"NANO", 1e-9},
                                                                          {"PICO", 1e-12},
                                                                          {"FEMTO", 1e-15},
                                                                          {"ATTO", 1e-18}}};
  for (const auto& [name, factor] : prefixes) {
    if (name == prefix) return factor;
  }
  unit.refuse(fmt::format("'{}' is not a prefix of SI units", prefix));
}

/// The size of a unit in metres or radians: of an SI unit, or of one that is defined by others.
double base_size_of(const StepEntity& unit, int depth) {
  if (depth > deepest_nesting) unit.refuse("the unit is defined by itself, or by too many others");
  if (unit.is("SI_UNIT")) {
    const StepValues values = unit.own("SI_UNIT", 1);
    return factor_of(values[0].word(), unit);
  }
  const StepValues values = unit.own("CONVERSION_BASED_UNIT", 1);
  const StepEntity measure = values[1].entity();
  const StepValues of_measure = measure.own("MEASURE_WITH_UNIT", 0);
  return of_measure[0].number() * base_size_of(of_measure[1].entity(), depth + 1);
}

void set_length(StepUnits& units, const StepEntity& unit) {
  constexpr double rounding = 1e-9;
  units.metres = base_size_of(unit, 0);
  if (!(units.metres > 0)) unit.refuse("the unit has no positive length; export the file again");
  for (const auto& [name, metres] : length_units) {
    if (std::abs(units.metres - metres) <= rounding * metres) units.length = name;
  }
  if (!units.length.empty()) return;
  const bool is_named = unit.is("CONVERSION_BASED_UNIT");
  units.length = is_named ? small_letters(unit.own("CONVERSION_BASED_UNIT", 1)[0].text())
                          : fmt::format("{:.6g} m", units.metres);
}

/// Many files give the degree with ten digits only.
void set_angle(StepUnits& units, const StepEntity& unit) {
  constexpr double degree = std::numbers::pi / 180, rounding = 1e-6;
  units.radians = base_size_of(unit, 0);
  if (!(units.radians > 0)) unit.refuse("the unit has no positive angle; export the file again");
  if (std::abs(units.radians - degree) <= rounding * degree) units.radians = degree;
}

}  // namespace

StepUnits units_of(const StepEntity& context) {
  StepUnits units;
  if (!context.is("GLOBAL_UNIT_ASSIGNED_CONTEXT")) return units;
  for (const StepValue value : context.own("GLOBAL_UNIT_ASSIGNED_CONTEXT", 2)[0].list()) {
    const StepEntity unit = value.entity();
    if (unit.is("LENGTH_UNIT")) set_length(units, unit);
    if (unit.is("PLANE_ANGLE_UNIT")) set_angle(units, unit);
  }
  return units;
}

}  // namespace quadloop::io
