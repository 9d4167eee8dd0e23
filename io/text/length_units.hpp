#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace quadloop {

/// Units of length by name, with metres per unit.
inline constexpr std::array<std::pair<const char*, double>, 17> length_units{{{"m", 1},
                                                                              {"mm", 1e-3},
                                                                              {"cm", 1e-2},
                                                                              {"dm", 0.1},
                                                                              {"dam", 10},
                                                                              {"hm", 100},
                                                                              {"km", 1e3},
                                                                              {"micron", 1e-6},
                                                                              {"nm", 1e-9},
                                                                              {"angstrom", 1e-10},
                                                                              {"inch", 0.0254},
                                                                              {"foot", 0.3048},
                                                                              {"yard", 0.9144},
                                                                              {"mile", 1609.344},
                                                                              {"mil", 2.54e-5},
                                                                              {"microinch", 2.54e-8},
                                                                              {"us_foot", 1200.0 / 3937}}};

/// Empty if no unit has this name.
inline std::optional<double> metres_in(std::string_view unit) {
  for (const auto& [name, metres] : length_units) {
    if (unit == name) return metres;
  }
  return {};
}

/// In the order of the table.
inline std::vector<std::string> length_unit_names() {
  std::vector<std::string> names;
  for (const auto& [name, metres] : length_units) names.emplace_back(name);
  return names;
}

}  // namespace quadloop
