#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapt/remesh/plan.hpp"
#include "adapt/transfer/transfer_by.hpp"

namespace quadloop::adapt {

/// Returns a mesh of which each rank has an even share, and whose cells are in the order of the quadtree
/// cells within each block, in the order of the quadtree, with its solution and tree. *Collective.*
SolvedMesh in_tree_order(const Communicator& comm, Mesh mesh, Field solution, TreeRecord tree);

/// Result of an initial adaptation pass, with a loosely converged solution.
struct PassRecord {
  std::int64_t nodes = 0;
  std::optional<double> cl, cd, residual;  ///< if the solver provides them
};

/// A new mesh with the transferred solution.
struct RemeshedSolution {
  GeneratedMesh generated;
  Field start;
  StageTimes times;                     ///< of mesh generation, and "transfer"
  TransferReport report;                ///< empty for the initial mesh
  bool morphed = false;                 ///< whether the cells are the old ones
  std::optional<double> estimate = {};  ///< interpolation error on the old mesh, if the plan has it
  std::optional<MetricStatistics> stretched = {};  ///< if the mesh follows a metric
  std::vector<PassRecord> passes = {};             ///< passes before a run's initial mesh

  /// Returns the drift of each variable's integral, with its name.
  std::vector<std::pair<std::string, double>> drifts() const;
};

/// Generates the mesh of the plan and transfers the solution, by a function if one is given. *Collective.*
RemeshedSolution remesh_and_transfer(const Communicator& comm, const MeshInput& input,
                                     const AdaptationPlan& plan, const SolvedMesh& old,
                                     const TransferFunction& by = {});

/// Returns a warning if a conservative transfer changed an integral by more than 1e-10 of its size. If the
/// two meshes cover different regions, up to ten times the change of area is accepted.
std::vector<std::string> drift_warnings(const RemeshedSolution& remeshed);

/// Returns the setting of the case that makes cells follow a solution, for messages; null if there is none. A
/// tree does not store it.
const char* setting_that_follows(const MeshInput& input);

/// Returns a plan without flags: the tree is kept, except for what case and geometry now request.
AdaptationPlan unchanged_plan(const TreeRecord& tree, const MeshInput& input);

}  // namespace quadloop::adapt
