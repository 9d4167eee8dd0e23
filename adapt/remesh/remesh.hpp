#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "adapt/remesh/plan.hpp"
#include "adapt/transfer/transfer.hpp"

namespace quadloop {

/// The whole mesh on the root, its cells in the order of the tree's leaves, with its solution and its tree,
/// spread over the ranks. *Collective.*
SolvedMesh spread_solved(const Communicator& comm, const Mesh& whole, const Field& solution, TreeRecord tree);

/// What a mesh on the way to a run's first one came to, solved roughly.
struct PassRecord {
  std::int64_t nodes = 0;
  std::optional<double> cl, cd, residual;  ///< where the solver knows them
};

/// A new mesh and the old one's solution on it.
struct CarriedMesh {
  GeneratedMesh generated;
  Field start;
  StageTimes times;                     ///< those of meshing, and "transfer"
  TransferReport report;                ///< none in a first mesh
  bool morphed = false;                 ///< the cells are the old ones
  std::optional<double> estimate = {};  ///< of the old mesh's interpolation error, where the plan has one
  std::optional<MetricFigures> stretched = {};  ///< where it follows a metric
  std::vector<PassRecord> passes = {};          ///< that led to a run's first mesh

  /// The drift of each variable's integral, by its name.
  std::vector<std::pair<std::string, double>> drifts() const;
};

/// Meshes by the plan and carries the solution over. *Collective.*
CarriedMesh carry_over(const Communicator& comm, const MeshInput& input, const AdaptationPlan& plan,
                       const SolvedMesh& old);

/// A warning where the transfer changed an integral that it has to keep by more than 1e-10 of its size. Two
/// meshes that cover different regions cannot keep it: there up to ten times the change of area is no fault.
std::vector<std::string> drift_warnings(const CarriedMesh& carried);

/// What in a case makes cells that follow a solution, as a text for messages; null where nothing does. A tree
/// keeps none of it.
const char* setting_that_follows(const MeshInput& input);

/// No marks: the tree stands, but for what case and geometry now ask for.
AdaptationPlan standing_plan(const TreeRecord& tree, const MeshInput& input);

}  // namespace quadloop
