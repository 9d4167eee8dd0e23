#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/cut/leaf_trace.hpp"
#include "mesher/forest/leaf_graph.hpp"

namespace quadloop {

/// A lattice corner that takes the place of the crossings near it: it moves onto the outline, and the
/// crossings become one node with it. Or a lattice edge that bends through a kept point, which becomes a node
/// of it.
struct Snap {
  std::int64_t x = 0, y = 0;  ///< the corner, in lattice units; the middle of an edge
  Point position;  ///< where it goes: the nearest point of the outline's run past it, or a kept point of the
                   ///< geometry
  Point corner;    ///< where the lattice has it
  double radius =
      0;  ///< vertices next to an absorbed crossing and nearer to the corner than this vanish in it
  struct Absorbed {
    std::int32_t segment = -1;
    bool vertical = false;  ///< whether the crossing lies on the vertical lattice line through the corner
    friend bool operator==(const Absorbed&, const Absorbed&) = default;
  };
  std::vector<Absorbed> absorbed;
  std::int32_t segment = -1;  ///< that a hanging node was moved onto where no crossing was near; else -1
  bool on_edge = false;       ///< an edge's, not a corner's
  bool vertical = false;      ///< of an edge
};

/// A snap as one leaf sees it: at a corner (0 to 3), a hanging node (4 to 7), or anywhere on a side (8 to 11)
/// of it.
struct LeafSnap {
  std::int32_t leaf = 0;
  int place = 0;
  const Snap* snap = nullptr;
};

/// The outline in this rank's leaves and in the ghost leaves.
struct TracedForest {
  LeafTraces traces;
  std::vector<std::int32_t> trace_of;  ///< of each leaf of the graph; -1 where it holds no geometry
};

/// Chooses the corners to snap: first those that kept points capture (capture_points), then those with a
/// crossing nearer than `share` of the shortest leaf edge there. Each corner is decided alone, from the
/// traces of the leaves around it, so that all ranks which see it decide the same. What follows is a
/// contraction: on each edge from the corner the crossings next to it are taken, of one run of the outline,
/// so the leaves around stay cut in the same pattern. A corner that takes two runs, or would swallow a kept
/// point, stays.
std::vector<Snap> choose_snaps(const LeafGraph& graph, const Lattice& lattice, const Geometry& geometry,
                               const TracedForest& traced, double share);

/// What each local leaf sees of the snaps, sorted by leaf. Points into `snaps`.
std::vector<LeafSnap> snaps_of_leaves(const LeafGraph& graph, const std::vector<Snap>& snaps);

}  // namespace quadloop
