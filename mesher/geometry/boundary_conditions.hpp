#pragma once

#include <array>
#include <string>
#include <vector>

namespace quadloop {

/// A word that Boundary::condition may be: how case files and our own files name what happens at a boundary.
struct BoundaryCondition {
  const char* word;
  const char* cgns_type;  ///< the name of its BCType_t in CGNS (SIDS)
};

/// All of them, in the order in which messages list them. What a solver can use of them is its own matter
/// (`flow/euler/scheme/flow_model`).
inline constexpr std::array<BoundaryCondition, 7> boundary_conditions{{
    {"wall", "BCWall"},
    {"farfield", "BCFarfield"},
    {"inflow", "BCInflow"},
    {"outflow", "BCOutflow"},
    {"symmetry", "BCSymmetryPlane"},
    {"interface", "UserDefined"},  // between two domains
    {"none", "UserDefined"},       // not said
}};

inline std::vector<std::string> condition_words() {
  std::vector<std::string> words;
  for (const BoundaryCondition& condition : boundary_conditions) words.emplace_back(condition.word);
  return words;
}

}  // namespace quadloop
