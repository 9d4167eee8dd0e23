#pragma once

#include <span>
#include <vector>

#include "mesher/forest/leaf_graph.hpp"
#include "mesher/snap/leaf_trace.hpp"

namespace quadloop {

/// How far a corner sees along a leaf edge, as a share of it: a little beyond the middle, so that every
/// crossing is seen from the end nearer to it, and lengths may be rounded. Crossings farther off bear on no
/// corner.
inline constexpr double sight_reach = 0.52;

/// A crossing as one of the corners at the ends of its leaf edge sees it, through one of the two leaves at
/// that edge.
struct Sight {
  LatticePoint corner;
  double distance = 0;  ///< along the edge
  double edge = 0;      ///< its length
  std::int32_t segment = -1;
  std::int32_t trace = -1, piece = -1;
  Direction direction = Direction::east;  ///< of the edge from the corner
  bool at_entry = false;                  ///< of the piece
};

/// What all corners of the local and the ghost leaves see within reach, the corners in the order of
/// comes_earlier. Of one corner: in the order of leaves and their pieces, along the curve.
std::vector<Sight> sights_by_corner(const LeafGraph& graph, const Lattice& lattice,
                                    const TracedForest& traced);

}  // namespace quadloop
