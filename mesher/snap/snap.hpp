#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/forest/leaf_graph.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// A grid vertex that moves onto the boundary, where it replaces the crossings near it by one node; or a grid
/// edge that bends through a kept point, which becomes a node of the edge; or a node inside a leaf.
struct Snap {
  GridPoint corner;  ///< for an edge or a leaf: its middle
  Point position;  ///< new position: the nearest point of the boundary's run past the vertex, or a kept point
  Point centre;    ///< vertices next to an absorbed crossing and within `radius` of this point vanish
  double radius = 0;
  struct Absorbed {
    std::int32_t segment = -1;
    bool vertical = false;  ///< the crossing is on the vertical grid line through `corner`
    friend auto operator<=>(const Absorbed&, const Absorbed&) = default;
  };
  std::vector<Absorbed> absorbed;  ///< ascending
  /// Segment onto which a hanging node was moved without a near crossing; else -1.
  std::int32_t segment = -1;
  bool on_edge = false;                     ///< for an edge, not a vertex
  bool vertical = false;                    ///< the edge is vertical
  bool in_leaf = false;                     ///< for a node inside a leaf that contains no geometry
  std::array<LeafId, 4> leaves_round = {};  ///< LeafFinder::leaves_round() of `corner`
};

/// The distance in which places at the snapped vertex differ by rounding only.
inline double rounding_at(const Snap& snap) { return 1e-9 * snap.radius; }

/// Whether the snap moves the vertex or edge by more than rounding. Others only absorb crossings.
inline bool moves(const Snap& snap) {
  return snap.on_edge || length(snap.position - snap.centre) >= rounding_at(snap);
}

/// Whether a segment between two blocks begins or ends at the vertex.
bool is_between_blocks(const Geometry& geometry, std::int32_t v);

/// Sorts what the snap absorbs, each crossing once, with those of twins.
void settle_absorbed(const Geometry& geometry, Snap& snap);

/// Sets `leaves_round` of the snaps; fast if consecutive snaps are near each other.
void find_leaves_round(const LeafGraph& graph, std::span<Snap> snaps);

/// A snap as seen by one leaf: at a corner, a hanging node, elsewhere on a side, or inside.
struct LeafSnap {
  LeafId leaf;
  Site site = Site::south_west;
  const Snap* snap = nullptr;
};

/// The snaps that affect each local leaf, sorted by leaf. Points into `snaps`.
std::vector<LeafSnap> snaps_of_leaves(const LeafGraph& graph, const std::vector<Snap>& snaps);

}  // namespace quadloop
