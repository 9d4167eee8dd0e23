#include <algorithm>
#include <array>

#include "adapt/metric/tile/operations.hpp"
#include "mesher/delaunay/flipper.hpp"

namespace quadloop::adapt {

namespace {

/// Fractions of the distance to the target position.
constexpr std::array<double, 4> relaxation_shares{0.8, 0.4, 0.2, 0.1};

/// The star of a node at another position: its worst quality, and the sum of the quality deficits.
struct StarQuality {
  double worst = 1, lack = 0;
};

std::optional<StarQuality> star_quality(const TileMesh& mesh, std::int32_t n, Point at) {
  StarQuality found;
  for (const std::int32_t t : mesh.star(n)) {
    const auto& nodes = mesh.triangle(t).nodes;
    std::array<Point, 3> p{mesh.point(nodes[0]), mesh.point(nodes[1]), mesh.point(nodes[2])};
    p[static_cast<std::size_t>(mesh.corner(t, n))] = at;
    if (!is_positive(p[0], p[1], p[2])) return {};
    const double quality = mesh.quality(nodes, p);
    found.worst = std::min(found.worst, quality);
    found.lack += 1 / quality;
  }
  return found;
}

/// The metric at a point in the star, interpolated in the triangle that contains it; that of the node if none
/// does (on curved walls).
LogMetric metric_at(const TileMesh& mesh, std::int32_t n, Point at) {
  for (const std::int32_t t : mesh.star(n)) {
    const auto& nodes = mesh.triangle(t).nodes;
    const Point a = mesh.point(nodes[0]), b = mesh.point(nodes[1]), c = mesh.point(nodes[2]);
    const double of_a = cross(b - at, c - at), of_b = cross(c - at, a - at), of_c = cross(a - at, b - at);
    if (of_a < 0 || of_b < 0 || of_c < 0) continue;
    const double sum = of_a + of_b + of_c;
    return LogMetric{of_a / sum * mesh.node(nodes[0]).metric + of_b / sum * mesh.node(nodes[1]).metric +
                     of_c / sum * mesh.node(nodes[2]).metric};
  }
  return mesh.node(n).metric;
}

/// The mean position at which the edges at the node would have equal lengths in the metric.
Point aim(const TileMesh& mesh, std::int32_t n) {
  const Point p = mesh.point(n);
  const std::vector<std::int32_t> around = mesh.neighbours(n);
  std::vector<double> lengths;
  double mean = 0;
  for (const std::int32_t other : around) {
    lengths.push_back(mesh.edge_length(n, other));
    mean += lengths.back() / static_cast<double>(around.size());
  }
  const double wanted = std::clamp(mean, 0.7, 1.4);
  Point sum;
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Point q = mesh.point(around[i]);
    sum = sum + q + wanted / lengths[i] * (p - q);
  }
  return 1 / static_cast<double>(around.size()) * sum;
}

bool take(TileMesh& mesh, std::int32_t n, const StarQuality& now, Point to) {
  const auto then = star_quality(mesh, n, to);
  if (!then || then->worst < now.worst || !(then->lack < now.lack)) return false;
  mesh.move_node(n, to, metric_at(mesh, n, to));
  return true;
}

bool relax_on_wall(TileMesh& mesh, std::int32_t n, const StarQuality& now) {
  const auto [before, after] = mesh.neighbours_on_wall(n);
  const std::int32_t boundary = mesh.boundary_of(n);
  const Walls& walls = mesh.walls();
  const Walls::Chord whole = mesh.chord(before, after, boundary);
  const smoother::OutlinePlace at = walls.place_of(mesh.point(n), boundary);
  if (!at.valid() || !whole.from.valid() || !whole.to.valid() || before == after) return false;
  const double back = mesh.edge_length(before, n), ahead = mesh.edge_length(n, after);
  const double way = ahead > back ? walls.way(at, whole.to) : walls.way(whole.from, at);
  const double step = (ahead - back) / (ahead + back) * way;
  for (const double share : relaxation_shares) {
    const smoother::OutlinePlace moved = walls.moved(at, share * step);
    const Point to = walls.point_at(moved);
    if (walls.may_slide(whole, moved, to, at, mesh.point(n)) && take(mesh, n, now, to)) return true;
  }
  return false;
}

}  // namespace

bool relax_node(TileMesh& mesh, std::int32_t n) {
  if (mesh.star(n).empty() || mesh.freedom(n) == TileMesh::Freedom::fixed) return false;
  const auto now = star_quality(mesh, n, mesh.point(n));
  if (!now) return false;
  if (mesh.freedom(n) == TileMesh::Freedom::slides) return relax_on_wall(mesh, n, *now);
  const Point from = mesh.point(n), way = aim(mesh, n) - from;
  return std::ranges::any_of(relaxation_shares,
                             [&](double share) { return take(mesh, n, *now, from + share * way); });
}

}  // namespace quadloop::adapt
