#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "adapt/metric/stretch_mesh.hpp"
#include "adapt/r_adaptation/move_nodes_to_shocks.hpp"
#include "adapt/remesh/demands/adapt_options.hpp"
#include "adapt/remesh/demands/solved_mesh.hpp"
#include "adapt/sensor/mark.hpp"
#include "generate/generate.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop::adapt {

/// Splits of the next tree, and how they were found.
struct AdaptationPlan {
  std::vector<SplitDemand> demands;  ///< from this rank's quadtree cells
  double mean = 0, deviation = 0;    ///< of log10 of the indicator; 0 for target sizes
  std::int64_t refined = 0, coarsened = 0;
  /// If the options have a norm: that of the interpolation error on the solved mesh.
  std::optional<double> estimate;
  /// If there is an estimate: `interpolation_error` and `target_size` of the cells.
  CellValues estimates_of_cells;
  MeasuredFlow measured;    ///< for layers that follow the flow; the same on every rank
  bool new_layers = false;  ///< whether heights or wakes differ from those of the last mesh
  /// Anisotropy of the next mesh: none, that of a metric (on the tree of the case alone), or quadtree cells
  /// with r-adaptation.
  std::variant<std::monostate, MetricDemand, TargetDemand> anisotropy;
  TransferKind transfer = TransferKind::linear;
  std::vector<std::string> warnings;
  bool flat = false;                 ///< whether the solution gives no reason to refine anywhere
  std::string reason_for_no_change;  ///< why no cell is refined or coarsened

  /// Without an effective flag, new layers or anisotropy the next mesh would be the same.
  bool changes_mesh() const {
    return refined + coarsened > 0 || new_layers || !std::holds_alternative<std::monostate>(anisotropy);
  }
};

/// Computes the demands of the next tree from a solution. By flags: sensor, flags, and a search among fewer
/// or more flags if the number of nodes is limited or prescribed (nodes are counted on the trees themselves,
/// MeshTrial). With a norm: target sizes of the quadtree cells, changing any number of levels, for a number
/// of nodes. For an anisotropic mesh: its metric. If walls specify a y+ and the solution provides friction,
/// first heights follow it from the next mesh on if any changes by more than 5 %; wakes that follow the flow
/// get the courses of its streamlines (wakes_to_follow()). Throws InputError if the
/// solution has no such variable, or one that is not finite. *Collective.*
AdaptationPlan plan_adaptation(const Communicator& comm, const MeshInput& input, const AdaptOptions& options,
                               const SolvedMesh& solved);

/// Throws InputError if adapt.min is smaller than the smallest possible quadtree cell, or, for a metric-based
/// mesh, larger than the largest size of the case.
void require_min_in_tree(const MeshInput& input, const AdaptOptions& options);

/// Throws InputError, with the least sufficient number, if the number of nodes of a metric-based mesh is too
/// small for the case's own sizes, judging by the mesh of the case's tree: every cycle would exceed it. For
/// meshes without layers. *Collective.*
void require_room_for_metric(const Communicator& comm, const MeshInput& input, const AdaptOptions& options,
                             const MeshResult& first);

}  // namespace quadloop::adapt
