#include <array>
#include <utility>

#include "io/text/plain_names.hpp"
#include "io/ugrid/ugrid_file.hpp"

namespace quadloop {

namespace {

/// FUN3D's: viscous wall, Riemann invariants, subsonic inflow by total pressure, subsonic outflow by
/// pressure, tangency.
constexpr std::array<std::pair<const char*, int>, 5> conditions{
    {{"wall", 4000}, {"farfield", 5000}, {"inflow", 7011}, {"outflow", 7012}, {"symmetry", 3000}}};
constexpr int symmetry_x = 6661;  // and y, z after it: the plane normal to the axis

}  // namespace

std::string mapbc_path(const std::string& path) {
  std::string stem = path.substr(0, path.size() - std::string(".ugrid").size());
  for (const char* ending : {".b8", ".lb8"}) {
    if (stem.ends_with(ending)) return stem.substr(0, stem.size() - std::string(ending).size()) + ".mapbc";
  }
  return stem + ".mapbc";
}

std::vector<std::string> mapbc_names(const std::vector<std::string>& names) { return plain_names(names); }

int mapbc_condition(const std::string& condition, char axis) {
  if (condition == "symmetry" && axis >= 'x' && axis <= 'z') return symmetry_x + (axis - 'x');
  for (const auto& [word, number] : conditions) {
    if (condition == word) return number;
  }
  return 0;
}

std::string condition_of_mapbc(int number) {
  if (number >= symmetry_x && number < symmetry_x + 3) return "symmetry";
  for (const auto& [word, known] : conditions) {
    if (number == known) return word;
  }
  return "none";
}

}  // namespace quadloop
