#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/forest/leaf_graph.hpp"

namespace quadloop {

/// A lattice corner that takes the place of the crossings near it: it moves onto the outline, and the
/// crossings become one node with it. Or a lattice edge that bends through a kept point, which becomes a node
/// of it.
struct Snap {
  LatticePoint corner;  ///< of an edge: its middle
  Point position;       ///< where it goes: the nearest point of the outline's run past it, or a kept point of
                        ///< the geometry
  Point centre;         ///< vertices next to an absorbed crossing and nearer to this than `radius` vanish
  double radius = 0;
  struct Absorbed {
    std::int32_t segment = -1;
    bool vertical = false;  ///< whether the crossing lies on the vertical lattice line through the corner
    friend auto operator<=>(const Absorbed&, const Absorbed&) = default;
  };
  std::vector<Absorbed> absorbed;  ///< ascending
  std::int32_t segment = -1;       ///< that a hanging node was moved onto where no crossing was near; else -1
  bool on_edge = false;            ///< an edge's, not a corner's
  bool vertical = false;           ///< of an edge
  std::array<LeafId, 4> leaves_round = {};  ///< LeafFinder::leaves_round() of `corner`
};

/// Fills in the leaves round the snaps; few steps each where they lie near each other.
void find_leaves_round(const LeafGraph& graph, std::span<Snap> snaps);

/// A snap as one leaf sees it: at a corner, a hanging node, or elsewhere on a side of it.
struct LeafSnap {
  LeafId leaf;
  Site site = Site::south_west;
  const Snap* snap = nullptr;
};

/// What each local leaf sees of the snaps, sorted by leaf. Points into `snaps`.
std::vector<LeafSnap> snaps_of_leaves(const LeafGraph& graph, const std::vector<Snap>& snaps);

}  // namespace quadloop
