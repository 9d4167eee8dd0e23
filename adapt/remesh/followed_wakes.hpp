#pragma once

#include <string>
#include <vector>

#include "adapt/remesh/demands/solved_mesh.hpp"
#include "generate/generate.hpp"

namespace quadloop::adapt {

/// Courses of the wakes that follow the flow, as in MeasuredFlow, and warnings about those that cannot.
struct FollowedWakes {
  std::vector<std::vector<Point>> paths;
  std::vector<std::string> warnings;
};

/// Returns the streamlines of a solution from the trailing edges, smoothed, with a point every half of the
/// wake's spacing, for the wakes with layers and then those without. A wake without streamline keeps the
/// course that the tree was made with. *Collective.*
FollowedWakes wakes_to_follow(const Communicator& comm, const MeshInput& input, const SolvedMesh& solved);

/// Whether any such wake differs by more than a fifth of the width of its columns, or, without layers, by
/// half the size of its cells.
bool other_wakes(const MeshInput& input, const MeasuredFlow& before, const MeasuredFlow& now);

}  // namespace quadloop::adapt
