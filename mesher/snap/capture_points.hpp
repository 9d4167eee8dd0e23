#pragma once

#include <cstdint>
#include <vector>

#include "mesher/snap/leaf_trace.hpp"
#include "mesher/snap/snap.hpp"

namespace quadloop {

/// How far a corner moves at most, as a share of the shortest edge there. Below one half, so that a point is
/// within reach of one corner only.
inline constexpr double corner_reach = 0.45;

/// A kept point of the geometry takes a lattice corner along that lies near it.
struct CornerCapture {
  LatticePoint corner;
  double distance = 0;
  std::int32_t vertex = -1;
  std::int32_t trace = -1, piece = -1;  ///< that the vertex lies on
};

/// What the kept points, and others where the outline turns sharply, take along: each the lattice corner next
/// to it, or else the lattice edge next to it, which then bends through it. So no sliver is left between a
/// point and a corner or an edge.
struct Captures {
  std::vector<CornerCapture> corners;  ///< in the order of comes_earlier; one each
  std::vector<Snap> edges;             ///< on_edge is set
};

/// Chosen from the traces of the local and the ghost leaves, each point alone, so that all ranks which see a
/// corner or an edge agree on it. `snap` as in choose_snaps; below its usual 0.4 less is captured.
Captures capture_points(const LeafGraph& graph, const Lattice& lattice, const Geometry& geometry,
                        const TracedForest& traced, double snap);

/// Hanging nodes that come near the outline in the leaf on whose side they hang, while it crosses no edge
/// next to them: they move onto its nearest point. In the order of the leaves.
std::vector<Snap> hanging_snaps(const LeafGraph& graph, const Lattice& lattice, const Geometry& geometry,
                                const TracedForest& traced, double share);

}  // namespace quadloop
