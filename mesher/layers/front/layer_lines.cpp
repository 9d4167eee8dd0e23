#include "mesher/layers/front/layer_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

namespace {

Point direction_of_segment(const Geometry& g, std::int32_t s) {
  return direction_of(g.point(s), g.point(g.next(s)));
}

BoundaryId boundary_named(const Geometry& g, const std::string& name) {
  const auto found = std::ranges::find(g.boundaries(), name, &Boundary::name);
  if (found == g.boundaries().end())
    throw InputError(fmt::format("[[wake]] from = \"{}\": the geometry has no boundary of that name", name));
  if (!found->layers)
    throw InputError(
        fmt::format("[[wake]] from = \"{}\": that boundary has no layers to go on; give it some", name));
  return BoundaryId{size32(std::vector<char>(found - g.boundaries().begin()))};
}

/// By how much the wall turns away from the domain: the cosine; 1 where it does not.
double cosine_of_turn(const Geometry& g, std::int32_t before, std::int32_t after) {
  const Point a = direction_of_segment(g, before), b = direction_of_segment(g, after);
  return cross(a, b) < 0 ? dot(a, b) : 1;
}

/// The first and the last vertex of an edge, blunt or sharp.
using Edge = std::pair<std::int32_t, std::int32_t>;

/// The base that begins at a corner, if there is one.
std::optional<Edge> base_from(const Geometry& g, std::int32_t v, double longest) {
  constexpr double cosine_of_corner = 0.64278760968653933;  // 50 degrees
  if (cosine_of_turn(g, g.previous(v), v) > cosine_of_corner) return std::nullopt;
  double way = 0;
  for (std::int32_t s = v;; s = g.next(s)) {
    way += length(g.point(g.next(s)) - g.point(s));
    if (way > longest || g.boundary_of(s) != g.boundary_of(v)) return std::nullopt;
    const std::int32_t end = g.next(s);
    if (cosine_of_turn(g, s, end) > cosine_of_corner) continue;
    const bool turns_back =
        dot(direction_of_segment(g, g.previous(v)), direction_of_segment(g, end)) < cosine_of_sharp_edge;
    return turns_back && g.boundary_of(end) == g.boundary_of(v) ? std::optional(Edge{v, end}) : std::nullopt;
  }
}

std::vector<Edge> edges_of(const Geometry& g, BoundaryId boundary) {
  constexpr double base_over_box = 0.05;
  std::vector<Edge> sharp, blunt;
  double low = g.box().high.x, high = g.box().low.x, bottom = g.box().high.y, top = g.box().low.y;
  for (std::int32_t v = 0; v < g.size(); ++v) {
    if (g.boundary_of(v) != boundary) continue;
    low = std::min(low, g.point(v).x), high = std::max(high, g.point(v).x);
    bottom = std::min(bottom, g.point(v).y), top = std::max(top, g.point(v).y);
  }
  const double longest_base = base_over_box * std::max(high - low, top - bottom);
  for (std::int32_t v = 0; v < g.size(); ++v) {
    if (g.boundary_of(v) != boundary || g.boundary_of(g.previous(v)) != boundary) continue;
    if (cosine_of_turn(g, g.previous(v), v) < cosine_of_sharp_edge) sharp.push_back({v, v});
    if (const auto base = base_from(g, v, longest_base)) blunt.push_back(*base);
  }
  return sharp.empty() ? blunt : sharp;
}

Edge edge_of(const Geometry& g, const std::string& name) {
  const std::vector<Edge> edges = edges_of(g, boundary_named(g, name));
  if (edges.size() == 1) return edges[0];
  if (edges.empty())
    throw InputError(
        fmt::format("[[wake]] from = \"{}\": the boundary has no edge, sharp (a turn of more than 120 "
                    "degrees) or blunt (two of more than 50 close together)",
                    name));
  const Point one = g.point(edges[0].first), other = g.point(edges[1].first);
  throw InputError(fmt::format(
      "[[wake]] from = \"{}\": the boundary has {} edges, at ({}, {}) and ({}, {}) for two; give each a "
      "boundary of its own",
      name, edges.size(), one.x, one.y, other.x, other.y));
}

PlacedLine placed(const Geometry& g, const LayerLine& line) {
  if (line.from.empty())
    return {PlacedLine::nowhere, PlacedLine::nowhere, line.path, line.spacing, *line.layers};
  const auto [first, last] = edge_of(g, line.from);
  std::vector<Point> path{first == last ? g.point(first) : 0.5 * (g.point(first) + g.point(last))};
  const bool repeats_edge = !line.path.empty() && line.path[0] == path[0];
  path.insert(path.end(), line.path.begin() + (repeats_edge ? 1 : 0), line.path.end());
  if (line.path.empty()) {
    const Point on = unit(direction_of_segment(g, g.previous(first)) - direction_of_segment(g, last));
    path.push_back(path[0] + line.length * on);
  }
  return {first, last, std::move(path), line.spacing, *g.boundary(g.boundary_of(first)).layers};
}

}  // namespace

std::vector<PlacedLine> place_lines(const Geometry& geometry, const std::vector<LayerLine>& lines) {
  std::vector<PlacedLine> all;
  for (const LayerLine& line : lines) all.push_back(placed(geometry, line));
  return all;
}

}  // namespace quadloop
