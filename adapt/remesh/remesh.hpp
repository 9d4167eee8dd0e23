#pragma once

#include <string>
#include <utility>
#include <vector>

#include "adapt/remesh/plan.hpp"
#include "io/loaded/loaded_mesh.hpp"

namespace quadloop {

/// The whole mesh on the root, its cells in the order of the tree's leaves, and its tree, spread over the
/// ranks. *Collective.*
SolvedMesh spread_solved(const Communicator& comm, const LoadedMesh& whole, TreeRecord tree);

/// A new mesh and the old one's solution on it.
struct CarriedMesh {
  GeneratedMesh generated;
  Field start;
  StageTimes times;                                   ///< those of meshing, and "transfer"
  std::int64_t outside = 0;                           ///< new nodes outside the old mesh
  std::vector<std::pair<std::string, double>> drift;  ///< of each variable's integral
};

/// Meshes by the plan and carries the solution over. *Collective.*
CarriedMesh carry_over(const Communicator& comm, const MeshInput& input, const AdaptationPlan& plan,
                       const SolvedMesh& old);

/// No marks: the tree stands, but for what case and geometry now ask for.
AdaptationPlan standing_plan(const TreeRecord& tree, const MeshInput& input);

}  // namespace quadloop
