#pragma once

#include <span>
#include <vector>

#include "mesher/forest/leaf_graph.hpp"
#include "mesher/snap/leaf_trace.hpp"

namespace quadloop {

/// Distance along a leaf edge within which a grid vertex sees crossings, as a fraction of the edge: slightly
/// more than half, so that every crossing is seen from its nearer end despite rounding. Crossings farther
/// away affect no vertex.
inline constexpr double sight_reach = 0.52;

/// A crossing as seen from a grid vertex at an end of its leaf edge, through one of the two leaves at that
/// edge.
struct Sight {
  GridPoint corner;
  double distance = 0;  ///< along the edge
  double edge = 0;      ///< length of the edge
  std::int32_t segment = -1;
  std::int32_t trace = -1, piece = -1;
  Direction direction = Direction::east;  ///< of the edge, from the vertex
  bool at_entry = false;                  ///< the crossing is the entry of the piece
};

/// The crossings within reach of all grid vertices of local and ghost leaves, by vertices in the order of
/// comes_earlier; for one vertex in the order of leaves and pieces along the curve. Of two twins only the
/// first is seen.
std::vector<Sight> sights_by_corner(const LeafGraph& graph, const TreeGrid& grid, const Geometry& geometry,
                                    const TracedForest& traced);

}  // namespace quadloop
