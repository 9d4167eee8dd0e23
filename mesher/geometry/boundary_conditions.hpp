#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace quadloop {

/// A boundary condition by name, as used in case files and in the program's own files.
struct BoundaryCondition {
  const char* word;
  const char* cgns_type;  ///< the BCType_t in CGNS (SIDS)
};

/// All names, in the order in which messages list them. The conditions that a solver supports are defined by
/// the solver (`flow/euler/model/flow_model`).
inline constexpr std::array<BoundaryCondition, 9> boundary_conditions{{
    {"wall", "BCWall"},
    {"viscous_wall", "BCWallViscous"},  // more specific kinds of wall, this and the next
    {"inviscid_wall", "BCWallInviscid"},
    {"farfield", "BCFarfield"},
    {"inflow", "BCInflow"},
    {"outflow", "BCOutflow"},
    {"symmetry", "BCSymmetryPlane"},
    {"interface", "UserDefined"},  // between two domains
    {"none", "UserDefined"},       // not specified
}};

inline bool is_wall(std::string_view condition) {
  return condition == "wall" || condition == "viscous_wall" || condition == "inviscid_wall";
}

/// The values of the key `bc` in case files. The kind of wall is given by the key `wall`: wall_words, with
/// "_wall" appended.
inline std::vector<std::string> condition_words() {
  std::vector<std::string> words;
  for (const BoundaryCondition& condition : boundary_conditions) {
    if (!std::string_view(condition.word).ends_with("_wall")) words.emplace_back(condition.word);
  }
  return words;
}
inline std::vector<std::string> wall_words() { return {"viscous", "inviscid"}; }

}  // namespace quadloop
