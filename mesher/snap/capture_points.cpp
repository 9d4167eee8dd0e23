#include "mesher/snap/capture_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "mesher/base/ids.hpp"
#include "mesher/forest/leaf_finder.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/snap/leaf_edge.hpp"

namespace quadloop {

namespace {

// Fractions of the local edge for the default snap tolerance.
constexpr double usual_snap = 0.4, edge_reach = 0.34;
/// A point with a larger turning angle captures grid vertices and edges even if it is not kept.
constexpr double pointed_degrees = 45;
/// A crossing nearer to the point is merged with the point by its edge.
constexpr double crossing_reach = 0.4;

/// Finds what one kept point captures.
class PointCapture {
 public:
  PointCapture(const LeafGraph& graph, const TreeGrid& grid, const Geometry& geometry, double snap)
      : graph_{graph},
        finder_{graph},
        grid_{grid},
        geometry_{geometry},
        share_{std::min(1.0, snap / usual_snap)} {}

  /// Whether a point lies on a side of the leaf; crossings there already have its position. Where blocks meet
  /// at it, only those of some may cross there.
  bool on_grid(LeafId leaf, Point p) const {
    const Box box = grid_.box_of(graph_.leaf(leaf));
    return p.x == box.low.x || p.x == box.high.x || p.y == box.low.y || p.y == box.high.y;
  }

  /// The corner of the leaf, or hanging node on its sides, within reach.
  std::optional<CornerCapture> corner_near(LeafId leaf, Point p) {
    std::optional<CornerCapture> nearest;
    bool contested = false;
    for (const Site site : grid_sites) {
      if (is_middle(site) && !graph_.has_hanging(leaf, side_of(site))) continue;
      const GridPoint corner = graph_.leaf(leaf).at(site);
      const double distance = length(grid_.corner(corner) - p);
      if (distance >= share_ * corner_reach * shortest_edge_of(graph_, grid_, finder_.leaves_round(corner)) ||
          (nearest && distance > nearest->distance))
        continue;
      contested = nearest && distance == nearest->distance;
      nearest = CornerCapture{corner, distance, -1, -1, -1};
    }
    return contested ? std::nullopt : nearest;
  }

  /// The edge of the leaf within reach, with the crossings that the point absorbs.
  std::optional<Snap> edge_near(LeafId leaf, std::int32_t vertex, const LeafTrace& view, const Piece& piece) {
    const Point p = geometry_.point(vertex);
    const std::optional<LeafEdge> nearest = quadloop::edge_near(graph_, grid_, leaf, p, share_);
    if (!nearest || across(*nearest) == LeafGraph::none) return std::nullopt;
    Snap snap;
    snap.corner = nearest->point((nearest->from + nearest->to) / 2);
    snap.position = snap.centre = p;
    snap.radius = share_ * edge_reach * nearest->length(grid_);
    snap.on_edge = true;
    snap.vertical = nearest->vertical();
    if (!take_crossings(*nearest, vertex, view, piece, snap)) return std::nullopt;
    return snap;
  }

 private:
  LeafId across(const LeafEdge& edge) {
    const bool ahead = edge.side == Side::right || edge.side == Side::top;
    const std::int64_t beyond = ahead ? edge.line : edge.line - 1;
    return edge.vertical() ? finder_.leaf_at(beyond, edge.from) : finder_.leaf_at(edge.from, beyond);
  }

  bool on_edge(const LeafEdge& edge, const Crossing& c) const {
    const double at = edge.along(c.position);
    return c.side == edge.side && edge.at(grid_, edge.from) <= at && at <= edge.at(grid_, edge.to);
  }

  /// Number of crossings on the edge's side of the leaf between two places along it, both included; twins
  /// count once. The
  /// crossings of a leaf are sorted once for all of its points.
  std::ptrdiff_t crossings_between(const LeafTrace& view, const LeafEdge& edge, double low, double high) {
    if (sorted_ != view.crossings.data()) {
      for (auto& places : places_) places.clear();
      for (const Crossing& c : view.crossings) {
        if (geometry_.is_second(c.segment)) continue;
        places_[index_of(c.side)].push_back(is_vertical(c.side) ? c.position.y : c.position.x);
      }
      for (auto& places : places_) std::sort(places.begin(), places.end());
      sorted_ = view.crossings.data();
    }
    const auto& places = places_[index_of(edge.side)];
    return std::ranges::upper_bound(places, high) - std::ranges::lower_bound(places, low);
  }

  /// Absorbs the crossings of the point's own piece that lie on the edge and near the point. Returns false if
  /// another crossing lies between, if another kept point is near, or if the part between point and crossing,
  /// which would vanish, contains a kept point or reaches far (a bay with a narrow mouth).
  bool take_crossings(const LeafEdge& edge, std::int32_t vertex, const LeafTrace& view, const Piece& piece,
                      Snap& snap) {
    const Point p = geometry_.point(vertex);
    const double size = edge.length(grid_);
    double low = edge.along(p), high = low;
    for (const std::int32_t c : {piece.entry, piece.exit}) {
      const Crossing& crossing = view.crossing(c);
      if (!on_edge(edge, crossing) || length(crossing.position - p) >= crossing_reach * size) continue;
      if (!may_vanish(between(view.vertices_of(piece), vertex, c == piece.entry), p, crossing_reach * size))
        return false;
      snap.absorbed.push_back({crossing.segment, edge.vertical()});
      low = std::min(low, edge.along(crossing.position));
      high = std::max(high, edge.along(crossing.position));
    }
    low = std::max(low, edge.at(grid_, edge.from));
    high = std::min(high, edge.at(grid_, edge.to));
    if (crossings_between(view, edge, low, high) > std::ssize(snap.absorbed)) return false;
    settle_absorbed(geometry_, snap);
    const auto vertices = view.vertices_of(piece);
    return std::none_of(vertices.begin(), vertices.end(), [&](std::int32_t v) {
      return v != vertex && geometry_.kept(v) && length(geometry_.point(v) - p) < crossing_reach * size;
    });
  }

  /// The vertices of a piece before or after one of them.
  static std::span<const std::int32_t> between(std::span<const std::int32_t> vertices, std::int32_t vertex,
                                               bool before) {
    const std::size_t at = std::find(vertices.begin(), vertices.end(), vertex) - vertices.begin();
    return before ? vertices.first(at) : vertices.subspan(at + 1);
  }

  bool may_vanish(std::span<const std::int32_t> vertices, Point into, double reach) const {
    return std::none_of(vertices.begin(), vertices.end(), [&](std::int32_t v) {
      return geometry_.kept(v) || length(geometry_.point(v) - into) >= reach;
    });
  }

  const LeafGraph& graph_;
  LeafFinder finder_;
  const TreeGrid& grid_;
  const Geometry& geometry_;
  double share_;
  const Crossing* sorted_ = nullptr;           ///< first crossing of the leaf that `places_` belongs to
  std::array<std::vector<double>, 4> places_;  ///< along each side, ascending
};

/// Of several vertices at one place, where blocks meet, that with fewer second twins comes first.
std::pair<int, std::int32_t> rank_of(const Geometry& geometry, std::int32_t v) {
  return {(geometry.is_second(v) ? 1 : 0) + (geometry.is_second(geometry.previous(v)) ? 1 : 0), v};
}

/// Where blocks meet, the first claim of several from one place stands for all of them.
template <class Claim, class Same>
void drop_copies(const Geometry& geometry, std::vector<Claim>& claims, const Same& same) {
  if (geometry.has_twins()) claims.erase(std::unique(claims.begin(), claims.end(), same), claims.end());
}

/// Of points that claim one grid vertex the nearest gets it; none if two are equally near.
std::vector<CornerCapture> settle_corners(const Geometry& geometry, std::vector<CornerCapture> claims) {
  std::sort(claims.begin(), claims.end(), [&](const CornerCapture& a, const CornerCapture& b) {
    return a.corner != b.corner       ? comes_earlier(a.corner, b.corner)
           : a.distance != b.distance ? a.distance < b.distance
                                      : rank_of(geometry, a.vertex) < rank_of(geometry, b.vertex);
  });
  drop_copies(geometry, claims, [&](const CornerCapture& a, const CornerCapture& b) {
    return a.corner == b.corner && geometry.point(a.vertex) == geometry.point(b.vertex);
  });
  std::vector<CornerCapture> settled;
  for (std::size_t begin = 0, end = 0; begin < claims.size(); begin = end) {
    while (end < claims.size() && claims[end].corner == claims[begin].corner) ++end;
    if (end - begin == 1 || claims[begin].distance < claims[begin + 1].distance)
      settled.push_back(claims[begin]);
  }
  return settled;
}

/// Moves one hanging node to the nearest point of the boundary in its leaf, if that is within reach and of no
/// other node.
std::optional<Snap> hanging_snap(const TreeGrid& grid, const Geometry& geometry, const LeafTrace& view,
                                 GridPoint corner, double reach) {
  const Point node = grid.corner(corner);
  Snap snap;
  snap.corner = corner;
  snap.centre = node;
  double nearest = reach;
  bool contested = false;  // two places are equally near
  for (const Piece& piece : view.pieces) {
    const auto vertices = view.vertices_of(piece);
    const auto try_segment = [&](std::int32_t s) {
      const Point p = nearest_on_segment(node, geometry.point(s), geometry.point(geometry.next(s)));
      if (length(p - node) > nearest || !view.box.contains(p)) return;
      contested = length(p - node) == nearest && snap.segment >= 0 && p != snap.position;
      nearest = length(p - node);
      snap.position = p;
      snap.segment = s;
    };
    if (piece.entry >= 0) try_segment(piece.first_segment);
    std::for_each(vertices.begin(), vertices.end(), try_segment);
  }
  if (snap.segment < 0 || contested) return std::nullopt;
  return snap;
}

/// An edge claimed by two points is given to neither.
std::vector<Snap> settle_edges(const Geometry& geometry, std::vector<Snap> claims) {
  const auto same = [](const Snap& a, const Snap& b) { return a.corner == b.corner; };
  std::sort(claims.begin(), claims.end(), [](const Snap& a, const Snap& b) {
    return a.corner != b.corner                     ? a.corner < b.corner
           : a.absorbed.size() != b.absorbed.size() ? a.absorbed.size() > b.absorbed.size()
                                                    : a.absorbed < b.absorbed;
  });
  drop_copies(geometry, claims,
              [&](const Snap& a, const Snap& b) { return same(a, b) && a.position == b.position; });
  std::vector<Snap> settled;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const bool contested = (i > 0 && same(claims[i - 1], claims[i])) ||
                           (i + 1 < claims.size() && same(claims[i], claims[i + 1]));
    if (!contested) settled.push_back(claims[i]);
  }
  return settled;
}

double line_of(const TreeGrid& grid, const LeafEdge& edge) {
  return edge.vertical() ? grid.x(edge.line) : grid.y(edge.line);
}

}  // namespace

std::optional<LeafEdge> edge_near(const LeafGraph& graph, const TreeGrid& grid, LeafId leaf, Point p,
                                  double share) {
  LeafEdge nearest;
  bool contested = false;
  double least = share * edge_reach;
  for (const Side side : all_sides) {
    const LeafEdge edge = leaf_edge_near(graph, grid, leaf, side, p);
    const double distance = std::abs(edge.across(p) - line_of(grid, edge)) / edge.length(grid);
    if (distance > least) continue;
    contested = distance == least;
    nearest = edge;
    least = distance;
  }
  if (contested || least == share * edge_reach) return std::nullopt;
  return nearest;
}

Captures capture_points(const LeafGraph& graph, const TreeGrid& grid, const Geometry& geometry,
                        const TracedForest& traced, double snap) {
  PointCapture capture(graph, grid, geometry, snap);
  std::vector<CornerCapture> corners;
  std::vector<Snap> edges;
  for (std::int32_t trace = 0; trace < size32(traced.leaves); ++trace) {
    const LeafId leaf = traced.leaves[trace];
    const LeafTrace view = traced.traces[trace];
    for (std::int32_t p = 0; p < std::ssize(view.pieces); ++p) {
      if (view.pieces[p].entry < 0) continue;
      for (const std::int32_t v : view.vertices_of(view.pieces[p])) {
        if (!geometry.kept(v) && geometry.turn_degrees(v) < pointed_degrees) continue;
        const bool on_grid = capture.on_grid(leaf, geometry.point(v));
        if (on_grid && !is_between_blocks(geometry, v)) continue;
        if (auto corner = capture.corner_near(leaf, geometry.point(v))) {
          corner->vertex = v;
          corner->trace = trace;
          corner->piece = p;
          corners.push_back(*corner);
        } else if (auto edge = on_grid || !geometry.kept(v)
                                   ? std::nullopt
                                   : capture.edge_near(leaf, v, view, view.pieces[p])) {
          edges.push_back(std::move(*edge));
        }
      }
    }
  }
  return {settle_corners(geometry, std::move(corners)), settle_edges(geometry, std::move(edges))};
}

std::vector<Snap> hanging_snaps(const LeafGraph& graph, const TreeGrid& grid, const Geometry& geometry,
                                const TracedForest& traced, double share) {
  std::vector<Snap> snaps;
  for (std::int32_t trace = 0; trace < size32(traced.leaves); ++trace) {
    const LeafId leaf = traced.leaves[trace];
    const Quadrant& q = graph.leaf(leaf);
    for (const Side side : all_sides) {
      if (!graph.has_hanging(leaf, side)) continue;
      auto snap = hanging_snap(grid, geometry, traced.traces[trace], q.at(middle_of(side)),
                               share * grid.edge(q.level + 1));
      if (snap) snaps.push_back(std::move(*snap));
    }
  }
  return snaps;
}

}  // namespace quadloop
