#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <iterator>
#include <set>
#include <utility>

#include "io/text/plain_names.hpp"
#include "io/text/text_scanner.hpp"
#include "io/ugrid/ugrid_file.hpp"
#include "mesher/base/suffix.hpp"

namespace quadloop::io {

namespace {

/// FUN3D's numbers: viscous wall, tangency, Riemann invariants, subsonic inflow by total pressure, subsonic
/// outflow by pressure. For a number the first condition is read.
constexpr std::array<std::pair<BoundaryCondition, int>, 7> conditions{
    {{BoundaryCondition::viscous_wall, 4000},
     {BoundaryCondition::inviscid_wall, 3000},
     {BoundaryCondition::farfield, 5000},
     {BoundaryCondition::inflow, 7011},
     {BoundaryCondition::outflow, 7012},
     {BoundaryCondition::wall, 4000},
     {BoundaryCondition::symmetry, 3000}}};
constexpr int symmetry_x = 6661;  // followed by y and z: the plane normal to the axis

}  // namespace

std::string mapbc_path(const std::string& path) {
  std::string stem = path;
  for (const std::string ending : {".ugrid", ".b8", ".lb8"}) {
    if (small_letters(stem).ends_with(ending)) stem.resize(stem.size() - ending.size());
  }
  return stem + ".mapbc";
}

std::string plane_mapbc_path(const std::string& path) { return path + ".mapbc"; }

std::vector<std::string> mapbc_names(const std::vector<std::string>& names) { return plain_names(names); }

std::string mapbc_text(const std::vector<MapbcPatch>& patches) {
  std::vector<std::string> names;
  for (const MapbcPatch& patch : patches) names.push_back(patch.name);
  names = mapbc_names(names);
  std::string text = std::to_string(names.size()) + "\n";
  for (std::size_t n = 0; n < names.size(); ++n)
    text += std::to_string(n + 1) + " " + std::to_string(patches[n].condition) + " " + names[n] + "\n";
  return text;
}

std::map<std::int32_t, MapbcPatch> read_mapbc(const std::string& path) {
  std::map<std::int32_t, MapbcPatch> patches;
  if (!std::filesystem::exists(path)) return patches;
  TextScanner scan(path);
  for (std::size_t left = scan.count("patches", 2); left > 0; --left) {
    const std::int64_t number = scan.integer("the number of a patch");
    const std::int64_t condition = scan.integer("the number of a boundary condition");
    const std::string name(scan.rest_of_line());
    patches[static_cast<std::int32_t>(number)] = {
        name.empty() ? "patch_" + std::to_string(number) : name.substr(0, name.find_first_of(" \t")),
        static_cast<int>(condition)};
  }
  return patches;
}

int mapbc_condition(BoundaryCondition condition, char axis) {
  if (condition == BoundaryCondition::symmetry && axis >= 'x' && axis <= 'z')
    return symmetry_x + (axis - 'x');
  for (const auto& [known, number] : conditions) {
    if (condition == known) return number;
  }
  return 0;
}

BoundaryCondition condition_of_mapbc(int number) {
  if (number >= symmetry_x && number < symmetry_x + 3) return BoundaryCondition::symmetry;
  for (const auto& [condition, known] : conditions) {
    if (number == known) return condition;
  }
  return BoundaryCondition::none;
}

}  // namespace quadloop::io
