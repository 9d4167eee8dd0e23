#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

/// A vertex of the geometry that is so sharp that no cell there can be better.
struct SharpPlace {
  Point place;
  double degrees = 0;  ///< smallest corner of a cell there that is excepted
};

/// How the shapes of cells are distributed. A corner below 30 degrees is excepted where the geometry made it,
/// not the mesher: on a vertex where the outline's own interior angle is below 60, or between two boundary
/// edges; or in a passage one cell wide, whose cells have all their nodes on the boundary but no two boundary
/// edges that meet. What there is nothing of is 0.
struct ShapeStatistics {
  std::int64_t corners = 0;  ///< of all cells
  /// Degrees; inverted ones too; none that is excepted.
  std::int64_t corners_below_15 = 0, corners_below_25 = 0, corners_below_26 = 0;
  std::int64_t corners_above_150 = 0;                ///< degrees
  std::int64_t corners_of_outline = 0;               ///< excepted ones on sharp vertices
  std::int64_t corners_in_passages = 0;              ///< other excepted ones
  double smallest_degrees = 0, largest_degrees = 0;  ///< of the corners that are not excepted
  /// Of the two cells at an inner edge, larger by smaller; infinite for cells without area.
  double area_ratio_max = 0, area_ratio_p99 = 0;
  double quad_share = 0;                 ///< quads by cells
  std::vector<SharpPlace> sharp_places;  ///< sharp vertices with excepted corners, by x, then by y
  std::vector<SharpPlace> passages;      ///< excepted corners in passages, likewise
};

/// Of the two cells at each inner edge, the larger area by the smaller: the largest, and the one that 99
/// percent of the edges do not exceed. Infinite for cells without area, 0 where there is no inner edge.
struct AreaRatios {
  double largest = 0, of_99_percent = 0;
};

/// Of a mesh that is whole on this rank and names existing nodes. Linear in time and memory.
AreaRatios area_ratios(const Mesh& whole_mesh);

/// Of a mesh that is whole on this rank and names existing nodes. `geometry` is what it was made from, the
/// domain to the left of every chain; without it no corner is excepted. Linear in time and memory.
ShapeStatistics shape_statistics(const Mesh& whole_mesh, const MeshTopology& topology,
                                 std::span<const Chain> geometry);

}  // namespace quadloop
