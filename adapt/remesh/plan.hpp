#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "adapt/metric/stretch_mesh.hpp"
#include "adapt/remesh/demands/adapt_options.hpp"
#include "adapt/remesh/demands/solved_mesh.hpp"
#include "adapt/sensor/mark.hpp"
#include "adapt/targets/gather_at_fronts.hpp"
#include "generate/generate.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop {

/// What the next tree is to be split at, and how that came about.
struct AdaptationPlan {
  std::vector<SplitDemand> demands;  ///< from this rank's share of leaves
  double mean = 0, deviation = 0;    ///< of log10 of the indicator; 0 for sizes
  std::int64_t refined = 0, coarsened = 0;
  /// Where the options have a norm: that of the interpolation error on the mesh that was solved on.
  std::optional<double> estimate;
  CellValues estimates_of_cells;  ///< then also `interpolation_error` and `wanted_size` of its cells
  MeasuredWall measured_wall;     ///< that first heights of layers are to follow; the same on every rank
  bool new_heights = false;       ///< they differ from those of the last mesh
  /// What anisotropic cells the next mesh is to have: none, those of a metric, on the tree of the case alone,
  /// or quadtree cells whose nodes are moved.
  std::variant<std::monostate, MetricDemand, TargetDemand> anisotropy;
  TransferKind transfer = TransferKind::linear;
  std::vector<std::string> warnings;
  bool flat = false;                ///< the solution asks for nothing anywhere
  std::string reason_for_standing;  ///< where no leaf is marked, why

  /// Without a mark that takes effect, or new heights, the next mesh would be the last one again.
  bool changes_mesh() const {
    return refined + coarsened > 0 || new_heights || !std::holds_alternative<std::monostate>(anisotropy);
  }
};

/// From a solution to the next tree's demands: sensor, marks, and a search among fewer or more marks where
/// the number of nodes is bounded or wanted; the nodes are counted on the trees themselves (MeshTrial); or,
/// where the options have a norm, sizes wanted of the leaves, of any number of levels, that lead to a number
/// of nodes; or, in a mesh that is to stretch, the metric that it is to follow. Where walls want a y+ and the
/// solution tells friction, first heights follow it, from the next mesh on if any changes by more than a
/// twentieth. *Collective.* Throws InputError where the solution has no such variable, or one that is not
/// finite.
AdaptationPlan plan_adaptation(const Communicator& comm, const MeshInput& input, const AdaptOptions& options,
                               const SolvedMesh& solved);

/// Throws InputError where adapt.min is smaller than leaves of the case's tree can be, or, where the
/// mesh follows a metric, larger than the largest size of the case.
void require_min_in_tree(const MeshInput& input, const AdaptOptions& options);

/// Refuses a number of nodes in which a mesh that follows a metric finds no place for the case's own sizes,
/// by the mesh of the case's tree: every cycle would come to more; of meshes without layers. Throws
/// InputError with the least that would do. *Collective.*
void require_room_for_metric(const Communicator& comm, const MeshInput& input, const AdaptOptions& options,
                             const MeshResult& first);

}  // namespace quadloop
