#include "mesher/layers/layer_lines.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/layers/wall_line.hpp"

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

std::int32_t sharp_edge_of(const Geometry& g, const std::string& name) {
  const BoundaryId boundary = boundary_named(g, name);
  std::vector<std::int32_t> edges;
  for (std::int32_t v = 0; v < g.size(); ++v) {
    if (g.boundary_of(v) != boundary || g.boundary_of(g.previous(v)) != boundary) continue;
    const Point before = direction_of_segment(g, g.previous(v)), after = direction_of_segment(g, v);
    if (cross(before, after) < 0 && dot(before, after) < cosine_of_sharp_edge) edges.push_back(v);
  }
  if (edges.size() == 1) return edges[0];
  if (edges.empty())
    throw InputError(fmt::format(
        "[[wake]] from = \"{}\": the boundary has no sharp edge (a turn of more than 120 degrees)", name));
  throw InputError(
      fmt::format("[[wake]] from = \"{}\": the boundary has {} sharp edges, at ({}, {}) and ({}, {}) for "
                  "two; give each a "
                  "boundary of its own",
                  name, edges.size(), g.point(edges[0]).x, g.point(edges[0]).y, g.point(edges[1]).x,
                  g.point(edges[1]).y));
}

PlacedLine placed(const Geometry& g, const LayerLine& line) {
  if (line.from.empty()) return {PlacedLine::nowhere, line.path, line.spacing, *line.layers};
  const std::int32_t edge = sharp_edge_of(g, line.from);
  std::vector<Point> path{g.point(edge)};
  path.insert(path.end(), line.path.begin(), line.path.end());
  if (line.path.empty()) {
    const Point on = unit(direction_of_segment(g, g.previous(edge)) - direction_of_segment(g, edge));
    path.push_back(g.point(edge) + line.length * on);
  }
  return {edge, std::move(path), line.spacing, *g.boundary(g.boundary_of(edge)).layers};
}

}  // namespace

std::vector<PlacedLine> place_lines(const Geometry& geometry, const std::vector<LayerLine>& lines) {
  std::vector<PlacedLine> all;
  for (const LayerLine& line : lines) all.push_back(placed(geometry, line));
  return all;
}

}  // namespace quadloop
