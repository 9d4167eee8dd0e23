#include <algorithm>
#include <array>

#include "adapt/metric/tile/operations.hpp"
#include "mesher/delaunay/flipper.hpp"

namespace quadloop::adapt {

namespace {

/// No new edge is shorter than this in the metric.
constexpr double least_new_length = 0.5;

/// The point at which an edge is divided.
struct Division {
  Point at;
  LogMetric metric;
  TileMesh::Freedom freedom = TileMesh::Freedom::free;
  std::int32_t boundary = -1;
};

std::optional<Division> division_of(const TileMesh& mesh, const TileMesh::Edge& edge) {
  const LogMetric middle{0.5 * (mesh.node(edge.a).metric + mesh.node(edge.b).metric)};
  if (edge.side.boundary < 0) return Division{0.5 * (mesh.point(edge.a) + mesh.point(edge.b)), middle};
  const Walls& walls = mesh.walls();
  const Walls::Chord chord = mesh.chord(edge.a, edge.b, edge.side.boundary);
  if (!walls.may_change(chord)) return {};
  const smoother::OutlinePlace place = walls.middle_of(chord);
  const Point at = walls.point_at(place);
  if (!walls.may_divide(chord, place, at)) return {};
  const auto freedom =
      walls.is_kept(at, edge.side.boundary) ? TileMesh::Freedom::fixed : TileMesh::Freedom::slides;
  return Division{at, middle, freedom, edge.side.boundary};
}

std::int32_t third_node(const TileMesh& mesh, std::int32_t t, const TileMesh::Edge& edge) {
  for (const std::int32_t n : mesh.triangle(t).nodes) {
    if (n != edge.a && n != edge.b) return n;
  }
  return -1;
}

/// Prevents more and more nodes accumulating beside an edge that must not change, however long it is in the
/// metric.
bool keeps_quality(const TileMesh& mesh, std::int32_t t, const std::array<std::int32_t, 3>& corners,
                   const Division& division) {
  constexpr double poor = 0.2;
  const auto& sides = mesh.triangle(t).sides;
  if (std::ranges::none_of(sides, [](const TileSide& side) { return side.locked; })) return true;
  const auto [a, b, c] = corners;
  const Metric middle = exp_of(division.metric);
  const auto quality = [&](std::int32_t end, Point from, Point to) {
    return quality_in(1.0 / 3 * (mesh.metric(end) + mesh.metric(c) + middle), from, to, mesh.point(c));
  };
  const double worst =
      std::min(quality(a, mesh.point(a), division.at), quality(b, division.at, mesh.point(b)));
  return worst >= std::min(poor, mesh.quality(t));
}

bool is_sound(const TileMesh& mesh, const TileMesh::Edge& edge, const Division& division, std::int32_t t) {
  if (t < 0) return true;
  const std::int32_t c = third_node(mesh, t, edge);
  const std::int32_t a = t == edge.left ? edge.a : edge.b, b = t == edge.left ? edge.b : edge.a;
  if (!is_positive(mesh.point(a), division.at, mesh.point(c))) return false;
  if (!is_positive(division.at, mesh.point(b), mesh.point(c))) return false;
  if (length_between(exp_of(division.metric), mesh.metric(c), mesh.point(c) - division.at) < least_new_length)
    return false;
  return keeps_quality(mesh, t, {a, b, c}, division);
}

/// Divides a triangle into two at node m on its edge from corner k to the next.
void divide(TileMesh& mesh, std::int32_t t, std::size_t k, std::int32_t m) {
  const TileTriangle whole = mesh.triangle(t);
  const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
  TileTriangle first = whole, second = whole;
  first.nodes[next] = m;
  first.sides[next] = {};
  second.nodes[k] = m;
  second.sides[last] = {};
  mesh.remove_triangle(t);
  mesh.add_triangle(first);
  mesh.add_triangle(second);
}

}  // namespace

bool split_edge(TileMesh& mesh, std::int32_t a, std::int32_t b) {
  const auto edge = mesh.edge(a, b);
  if (!edge || edge->side.locked) return false;
  const auto division = division_of(mesh, *edge);
  if (!division || !is_sound(mesh, *edge, *division, edge->left) ||
      !is_sound(mesh, *edge, *division, edge->right))
    return false;
  const std::int32_t m = mesh.add_node(division->at, division->metric, division->freedom, division->boundary);
  for (const std::int32_t t : {edge->left, edge->right}) {
    if (t < 0) continue;
    const int from = mesh.corner(t, t == edge->left ? edge->a : edge->b);
    divide(mesh, t, static_cast<std::size_t>(from), m);
  }
  return true;
}

}  // namespace quadloop::adapt
