#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mesher/snap/leaf_edge.hpp"
#include "mesher/snap/leaf_trace.hpp"
#include "mesher/snap/snap.hpp"

namespace quadloop {

/// Largest movement of a grid vertex, as a fraction of the shortest edge there. Less than one half, so that a
/// point is within reach of one vertex only.
inline constexpr double corner_reach = 0.45;

/// A kept point of the geometry that captures a nearby grid vertex.
struct CornerCapture {
  GridPoint corner;
  double distance = 0;
  std::int32_t vertex = -1;
  std::int32_t trace = -1, piece = -1;  ///< trace and piece that contain the geometry vertex
};

/// The edge of the leaf nearest to the point, relative to the edge's length. None if none is within `share`
/// of the reach of edges, or if two are equally near.
std::optional<LeafEdge> edge_near(const LeafGraph& graph, const TreeGrid& grid, LeafId leaf, Point p,
                                  double share);

/// The grid vertices and edges captured by kept points and other points with sharp turns: each captures the
/// nearest grid vertex, or else the nearest grid edge, which then bends through the point. So no slivers
/// remain between a point and a vertex or an edge.
struct Captures {
  std::vector<CornerCapture> corners;  ///< in the order of comes_earlier; at most one per grid vertex
  std::vector<Snap> edges;             ///< with on_edge set
};

/// Computed from the traces of local and ghost leaves, for each point separately, so that all ranks that see
/// a grid vertex or edge agree. `snap` as in choose_snaps; below its default 0.4 fewer are captured.
Captures capture_points(const LeafGraph& graph, const TreeGrid& grid, const Geometry& geometry,
                        const TracedForest& traced, double snap);

/// Snaps hanging nodes that are near the boundary in the leaf with the hanging node, if no adjacent edge is
/// crossed: they move to the nearest point of the boundary. In the order of the leaves.
std::vector<Snap> hanging_snaps(const LeafGraph& graph, const TreeGrid& grid, const Geometry& geometry,
                                const TracedForest& traced, double share);

}  // namespace quadloop
