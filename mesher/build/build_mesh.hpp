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
#include "mesher/geometry/periodic_pair.hpp"
#include "mesher/geometry/required_point.hpp"
#include "mesher/grid/size_options.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"
#include "mesher/sizes/demanded_splits.hpp"

namespace quadloop {

/// Cell types of a mesh: hybrid: quadrilaterals where they fit, else triangles; delaunay: triangles only,
/// constrained Delaunay over the whole domain; metric: outside of layers such triangles until there is a
/// solution, then triangles that follow its metric.
enum class MeshType { hybrid, delaunay, metric };
/// Whether a mesh has no quadrilaterals outside of layers.
inline bool has_triangles_alone(MeshType type) { return type != MeshType::hybrid; }
/// Whether layers consist of triangles too. Beside anisotropic triangles they are quadrilaterals, which
/// viscous flow requires.
inline bool divides_layers(MeshType type) { return type == MeshType::delaunay; }

/// Quadrilaterals of a hybrid mesh: all well-shaped ones, or only parallelograms, the others being split.
enum class QuadChoice { all, parallel };

/// Limits on the size of a mesh.
struct MeshLimit {
  static constexpr double none = std::numeric_limits<double>::infinity();
  double cells = none;
  double bytes = none;  ///< of memory, over all ranks
  int ranks = 1;        ///< number of ranks that share it
};

/// Estimated size of a mesh, before it is generated.
struct MeshEstimate {
  double leaves = 0, cells = 0;
  double bytes = 0;          ///< memory distributed over the ranks
  double bytes_of_rank = 0;  ///< additional memory on each rank
  double layer_cells = 0;    ///< number of cells in wall layers
};

/// Thrown if a mesh would have more cells than allowed, or exceed free memory.
class TooManyCells : public InputError {
 public:
  using InputError::InputError;
};

/// Options of mesh generation from a geometry.
struct MeshOptions {
  MeshType type = MeshType::hybrid;
  QuadChoice quads = QuadChoice::all;
  SizeOptions size;
  /// Snap tolerance: a grid vertex closer to a crossing than this fraction of the local edge moves onto the
  /// boundary; 0 <= snap < 0.5.
  double snap = 0.4;
  /// If true, a boundary whose loops are all smaller than the smallest leaf is dropped; otherwise it is an
  /// error.
  bool may_vanish = false;
  MeshLimit limit;  ///< does not affect the mesh unless it is exceeded
  /// The mesh must be symmetric in this axis, as the geometry is. build_mesh() guarantees this if sizes and
  /// root are symmetric; the axis must be a line between leaves.
  std::optional<MirrorAxis> mirror = {};
  /// Pairs of boundaries of the geometry, each the exact image of the other. build_mesh() does not know them:
  /// generate_mesh() makes their nodes match.
  std::vector<PeriodicPair> pairs = {};
  /// Points that must be nodes. build_mesh() makes them nodes, generate_mesh() names these nodes and checks
  /// that there is one for each point.
  std::vector<RequiredPoint> required_points = {};
};

/// Report of mesh generation for the user. Numbers are over all ranks, the same on each.
struct MeshReport {
  std::int64_t leaves = 0, cut_leaves = 0, islands_dropped = 0;
  std::int64_t regions = 0;       ///< connected regions of the domain
  MeshEstimate estimate;          ///< made before mesh generation
  double area_dropped = 0;        ///< of the dropped loops; negative for islands
  std::int64_t corners_lost = 0;  ///< feature points of the geometry that are not mesh nodes
  int coarsest_level = 0, finest_level = 0;
  int finest_allowed = 0;  ///< maximum leaf level
  double imbalance = 1;    ///< maximum over mean work of the ranks, by the weights of the partition
  std::vector<std::string> boundaries_vanished;  ///< names of boundaries without mesh edges
  std::vector<std::string> warnings;             ///< one line each: what was dropped or coarsened, and where
  StageTimes times;                              ///< of this rank
};

struct MeshResult {
  Mesh mesh;
  TreeRecord tree;  ///< case and coordinate digests are set by the caller
  /// For each boundary edge on this rank its leaf, as index into tree.leaves; ascending.
  std::vector<std::vector<std::int32_t>> edge_leaves;
  MeshReport report;
};

/// Sets the tree's numbers of nodes and cells over all ranks. *Collective.*
void count_entries(const Communicator& comm, MeshResult& result);

/// Generates the mesh of the domain of `geometry`. The mesh depends only on geometry, options and adaptation
/// demands. Throws InputError if the geometry cannot be meshed with these options, TooManyCells if they
/// exceed options.limit. *Collective.*
MeshResult build_mesh(const Communicator& comm, const Geometry& geometry, const MeshOptions& options,
                      const DemandedSplits& demanded = {});

}  // namespace quadloop
