#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace quadloop {

/// A word that Boundary::condition may be: how case files and our own files name what happens at a boundary.
struct BoundaryCondition {
  const char* word;
  const char* cgns_type;  ///< the name of its BCType_t in CGNS (SIDS)
};

/// All of them, in the order in which messages list them. What a solver can use of them is its own matter
/// (`flow/euler/model/flow_model`).
inline constexpr std::array<BoundaryCondition, 9> boundary_conditions{{
    {"wall", "BCWall"},
    {"viscous_wall", "BCWallViscous"},  // these two: a wall of which more is said
    {"inviscid_wall", "BCWallInviscid"},
    {"farfield", "BCFarfield"},
    {"inflow", "BCInflow"},
    {"outflow", "BCOutflow"},
    {"symmetry", "BCSymmetryPlane"},
    {"interface", "UserDefined"},  // between two domains
    {"none", "UserDefined"},       // not said
}};

inline bool is_wall(std::string_view condition) {
  return condition == "wall" || condition == "viscous_wall" || condition == "inviscid_wall";
}

/// Those that a case's key `bc` takes; `wall` says more of a wall: wall_words, each with "_wall" behind it.
inline std::vector<std::string> condition_words() {
  std::vector<std::string> words;
  for (const BoundaryCondition& condition : boundary_conditions) {
    if (!std::string_view(condition.word).ends_with("_wall")) words.emplace_back(condition.word);
  }
  return words;
}
inline std::vector<std::string> wall_words() { return {"viscous", "inviscid"}; }

}  // namespace quadloop
