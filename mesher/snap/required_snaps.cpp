#include "mesher/snap/required_snaps.hpp"

#include <algorithm>
#include <optional>

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

/// The leaf of a point that becomes a node.
class PointLeaf {
 public:
  PointLeaf(const LeafGraph& graph, const TreeGrid& grid, LeafFinder& finder, LeafId leaf)
      : graph_{graph}, grid_{grid}, finder_{finder}, leaf_{leaf} {}

  RequiredSnap snap(Point p) {
    if (const auto vertex = vertex_near(p)) return {*vertex, p};
    if (const auto edge = edge_to_bend(p))
      return {edge->point((edge->from + edge->to) / 2), p, true, edge->vertical(), false};
    const Quadrant& q = graph_.leaf(leaf_);
    return {{q.x + q.size() / 2, q.y + q.size() / 2}, p, false, false, true};
  }

 private:
  /// Largest movement of a hanging node, as a fraction of the leaf's edge.
  static constexpr double hanging_reach = 0.3;
  static constexpr double full_reach = 1;
  /// Of edges between leaves of two sizes, where an additional node makes triangles thinner.
  static constexpr double uneven_reach = 0.6;

  /// The nearest corner of the leaf, or hanging node on its sides, within reach.
  std::optional<GridPoint> vertex_near(Point p) const {
    const Quadrant& q = graph_.leaf(leaf_);
    std::optional<GridPoint> nearest;
    double least = 1;
    for (const Site site : grid_sites) {
      if (is_middle(site) && !graph_.has_hanging(leaf_, side_of(site))) continue;
      const double distance = length(grid_.corner(q.at(site)) - p) / grid_.edge(q.level);
      if (distance >= std::min(least, is_middle(site) ? hanging_reach : corner_reach)) continue;
      nearest = q.at(site);
      least = distance;
    }
    return nearest;
  }

  std::optional<LeafEdge> edge_to_bend(Point p) {
    const auto edge = edge_near(graph_, grid_, leaf_, p, full_reach);
    return edge && is_uneven(*edge) ? edge_near(graph_, grid_, leaf_, p, uneven_reach) : edge;
  }

  /// Whether the leaf across is of another size.
  bool is_uneven(const LeafEdge& edge) {
    const bool ahead = edge.side == Side::right || edge.side == Side::top;
    const std::int64_t beyond = ahead ? edge.line : edge.line - 1;
    const LeafId across =
        edge.vertical() ? finder_.leaf_at(beyond, edge.from) : finder_.leaf_at(edge.from, beyond);
    return across == LeafGraph::none || graph_.leaf(across).level != graph_.leaf(leaf_).level;
  }

  const LeafGraph& graph_;
  const TreeGrid& grid_;
  LeafFinder& finder_;
  LeafId leaf_;
};

}  // namespace

std::vector<Snap> required_snaps(const Communicator& comm, const LeafGraph& graph, const TreeGrid& grid,
                                 std::span<const Point> points) {
  std::vector<Snap> snaps;
  if (points.empty()) return snaps;
  LeafFinder finder(graph);
  std::vector<RequiredSnap> own;
  for (const Point p : points) {
    const LeafId leaf = finder.leaf_at(grid.column_at(p.x), grid.row_at(p.y));
    if (graph.is_local(leaf)) own.push_back(PointLeaf(graph, grid, finder, leaf).snap(p));
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
