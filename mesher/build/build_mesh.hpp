#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/timer.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/lattice/size_options.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"
#include "mesher/sizes/demanded_splits.hpp"

namespace quadloop {

/// Which cells a mesh has: quadrilaterals where they fit and triangles, or triangles alone, constrained
/// Delaunay over the whole domain; or such triangles until there is a solution, whose metric they then
/// follow.
enum class MeshType { hybrid, delaunay, metric };
inline bool has_triangles_alone(MeshType type) { return type != MeshType::hybrid; }

/// Which quadrilaterals a hybrid mesh keeps: all that are in good shape, or parallelograms alone, the others
/// being divided.
enum class QuadChoice { all, parallel };

/// How much a mesh may cost.
struct MeshLimit {
  static constexpr double none = std::numeric_limits<double>::infinity();
  double cells = none;
  double bytes = none;  ///< of memory, over all ranks
  int ranks = 1;        ///< that share it
};

/// What a mesh is expected to cost, before it is made.
struct MeshEstimate {
  double leaves = 0, cells = 0;
  double bytes = 0;          ///< of memory, shared out over the ranks
  double bytes_of_rank = 0;  ///< beside that, on each
  double layer_cells = 0;    ///< of the cells those in layers at walls
};

/// Refuses a mesh that would have more cells than are allowed, or than memory holds.
class TooManyCells : public InputError {
 public:
  using InputError::InputError;
};

/// How a mesh is made from a geometry.
struct MeshOptions {
  MeshType type = MeshType::hybrid;
  QuadChoice quads = QuadChoice::all;
  SizeOptions size;
  double snap = 0.4;  ///< a lattice corner nearer to a crossing than this share of the local edge moves onto
                      ///< the boundary; 0 <= snap < 0.5
  bool may_vanish = false;  ///< a boundary all of whose loops are smaller than the smallest leaf is dropped;
                            ///< otherwise it is refused
  MeshLimit limit;          ///< has no influence on the mesh, if there is one
  /// The mesh is to be its own mirror image in this axis, as the geometry is. build_mesh() makes it so where
  /// sizes and root are; the axis must be a line between leaves.
  std::optional<MirrorAxis> mirror = {};
};

/// What a user is told of a mesh's making. The numbers are over all ranks, the same on each.
struct MeshReport {
  std::int64_t leaves = 0, cut_leaves = 0, islands_dropped = 0;
  std::int64_t regions = 0;       ///< connected regions of the domain
  MeshEstimate estimate;          ///< as it was known before the meshing
  double area_dropped = 0;        ///< of the loops dropped; below 0 for islands
  std::int64_t corners_lost = 0;  ///< kept corners of the outline that are no nodes
  int coarsest_level = 0, finest_level = 0;
  int finest_allowed = 0;  ///< level that no leaf may pass
  double imbalance = 1;    ///< the heaviest rank's work over the mean, as the partition weighs it
  std::vector<std::string> boundaries_vanished;  ///< names of those that the mesh has no edge of
  std::vector<std::string> warnings;             ///< one line each: what was dropped or coarsened, and where
  StageTimes times;                              ///< of this rank
};

struct MeshResult {
  Mesh mesh;
  TreeRecord tree;  ///< its digests of case and coordinates are left to the caller
  /// Of each boundary's edges on this rank: the leaf that it belongs to, by its index in tree.leaves;
  /// ascending.
  std::vector<std::vector<std::int32_t>> edge_leaves;
  MeshReport report;
};

/// Sets what the tree says of the numbers of nodes and cells over all ranks. *Collective.*
void count_entries(const Communicator& comm, MeshResult& result);

/// Meshes the domain of `geometry`: the mesh is a function of geometry, options and what adaptation has
/// demanded of the tree. *Collective.* Throws InputError where the geometry cannot be meshed with these
/// options, TooManyCells where they ask for more than options.limit.
MeshResult build_mesh(const Communicator& comm, const Geometry& geometry, const MeshOptions& options,
                      const DemandedSplits& demanded = {});

}  // namespace quadloop
