#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/check/edge_statistics.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A sharp vertex of the geometry, which limits the cell angles there.
struct SharpPlace {
  Point place;
  double degrees = 0;  ///< smallest exempt cell angle there
};

/// Distribution of cell shapes. An angle below 30 degrees is exempt if the geometry causes it: at a vertex
/// where the interior angle of the geometry is below 60, or between two boundary edges; or in a passage one
/// cell wide, whose cells have all nodes on the boundary but no two boundary edges that meet. Empty
/// statistics are 0.
struct ShapeStatistics {
  std::int64_t corners = 0;  ///< of all cells
  /// Angles in degrees, including inverted ones, without exempt ones.
  std::int64_t corners_below_15 = 0, corners_below_25 = 0, corners_below_26 = 0;
  std::int64_t corners_above_150 = 0;                ///< degrees
  std::int64_t corners_of_outline = 0;               ///< exempt corners at sharp vertices
  std::int64_t corners_in_passages = 0;              ///< other exempt corners
  double smallest_degrees = 0, largest_degrees = 0;  ///< of the corners that are not exempt
  /// Ratio of the two cell areas at an inner edge, larger by smaller; infinite for cells without area.
  double area_ratio_max = 0, area_ratio_p99 = 0;
  double quad_share = 0;                 ///< quads / cells
  std::vector<SharpPlace> sharp_places;  ///< sharp vertices with exempt corners, sorted by x, then y
  std::vector<SharpPlace> passages;      ///< exempt corners in passages, in the same order
};

/// `halo` and `edges` are those of `mesh`, which must have valid node numbers. `geometry`, the same on every
/// rank, is what it was made from, the domain to the left of every chain; without it no corner is exempt.
/// Linear in time. Independent of the number of ranks. *Collective.*
ShapeStatistics shape_statistics(const Communicator& comm, const Mesh& mesh, const HaloMesh& halo,
                                 const EdgeStatistics& edges, std::span<const Chain> geometry);

}  // namespace quadloop
