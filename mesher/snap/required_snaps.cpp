#include "mesher/snap/required_snaps.hpp"

#include "mesher/forest/leaf_finder.hpp"
#include "mesher/snap/capture_points.hpp"

namespace quadloop {

namespace {

/// A snap in a form that is sent to other ranks.
struct RequiredSnap {
  GridPoint corner;
  Point position;
  bool on_edge = false, vertical = false, in_leaf = false;
};

RequiredSnap snap_in(const LeafGraph& graph, const TreeGrid& grid, LeafFinder& finder, LeafId leaf, Point p) {
  constexpr double full_reach = 1;
  if (const auto corner = corner_near(graph, grid, finder, leaf, p, full_reach)) return {corner->corner, p};
  if (const auto edge = edge_near(graph, grid, leaf, p, full_reach))
    return {edge->point((edge->from + edge->to) / 2), p, true, edge->vertical(), false};
  const Quadrant& q = graph.leaf(leaf);
  return {{q.x + q.size() / 2, q.y + q.size() / 2}, p, false, false, true};
}

}  // namespace

std::vector<Snap> required_snaps(const Communicator& comm, const LeafGraph& graph, const TreeGrid& grid,
                                 std::span<const Point> points) {
  std::vector<Snap> snaps;
  if (points.empty()) return snaps;
  LeafFinder finder(graph);
  std::vector<RequiredSnap> own;
  for (const Point p : points) {
    const LeafId leaf = finder.leaf_at(grid.column_at(p.x), grid.row_at(p.y));
    if (graph.is_local(leaf)) own.push_back(snap_in(graph, grid, finder, leaf, p));
  }
  for (const RequiredSnap& one : comm.all_gather_values(std::span<const RequiredSnap>(own))) {
    Snap& snap = snaps.emplace_back();
    snap.corner = one.corner;
    snap.position = snap.centre = one.position;
    snap.on_edge = one.on_edge;
    snap.vertical = one.vertical;
    snap.in_leaf = one.in_leaf;
  }
  find_leaves_round(graph, snaps);
  return snaps;
}

}  // namespace quadloop
