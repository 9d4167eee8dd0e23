#include "generate/pair_sides.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {

namespace {

/// The vertices of a boundary that is one open line, in order.
std::vector<std::int32_t> vertices_of(const Geometry& geometry, const std::string& boundary) {
  const auto is_of = [&](std::int32_t s) {
    return geometry.boundary(geometry.boundary_of(s)).name == boundary;
  };
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    if (!is_of(v) || is_of(geometry.previous(v))) continue;
    std::vector<std::int32_t> vertices{v};
    while (is_of(vertices.back())) vertices.push_back(geometry.next(vertices.back()));
    return vertices;
  }
  throw InputError(fmt::format("boundary '{}' of a [[pair]] is not one open line", boundary));
}

}  // namespace

PairOutline::PairOutline(const Geometry& geometry, const PeriodicPair& pair)
    : geometry_{geometry},
      from_{pair.from, vertices_of(geometry, pair.from)},
      to_{pair.to, vertices_of(geometry, pair.to)} {
  constexpr double rounding = 1e-9;
  std::ranges::reverse(to_.vertices);
  for (const std::int32_t v : from_.vertices) {
    const double before = arcs_.empty() ? 0 : arcs_.back();
    arcs_.push_back(
        arcs_.empty() ? 0
                      : before + quadloop::length(geometry.point(v) - geometry.point(geometry.previous(v))));
  }
  for (std::size_t i = 0; i < std::min(from_.vertices.size(), to_.vertices.size()); ++i) {
    const Point p = geometry.point(from_.vertices[i]), q = geometry.point(to_.vertices[i]);
    const bool is_last = i + 1 == from_.vertices.size(), of_other = i + 1 == to_.vertices.size();
    if (quadloop::length(pair.image(p) - q) <= rounding * length() && is_last == of_other) continue;
    throw InputError(fmt::format(
        "boundary '{}' of a [[pair]] has a point at ({:.6g}, {:.6g}) whose image is "
        "not on '{}'; reduce spacing.min, move the points nearby apart, or remove layers that end on "
        "curved sides",
        pair.from, p.x, p.y, pair.to));
  }
}

std::vector<double> PairOutline::arcs_on(const Side& side, bool reverse, const smoother::OutlinePath& path,
                                         const std::vector<Point>& nodes) const {
  std::vector<std::int32_t> index_of(geometry_.size(), -1);
  for (std::int32_t i = 0; i < size32(side.vertices); ++i) index_of[side.vertices[i]] = i;
  std::vector<double> arcs;
  for (const Point p : nodes) {
    const std::int32_t segment = path.locate(p, side.name).segment;
    if (segment < 0)
      throw InputError(
          fmt::format("boundary '{}' of a [[pair]]: the node at ({:.6g}, {:.6g}) is not on it; "
                      "use a smaller spacing there",
                      side.name, p.x, p.y));
    // The chord from vertex i to i + 1; a node at the end of the line may be located on the next segment.
    const std::int32_t i = std::clamp(index_of[segment] - (reverse ? 1 : 0), 0, size32(side.vertices) - 2);
    const Point a = geometry_.point(side.vertices[i]), b = geometry_.point(side.vertices[i + 1]);
    const double share = place_on_segment(p, a, b).parameter;
    arcs.push_back(p == b ? arcs_[i + 1] : p == a ? arcs_[i] : arcs_[i] + share * (arcs_[i + 1] - arcs_[i]));
  }
  return arcs;
}

std::vector<double> PairOutline::arcs_on_from(const smoother::OutlinePath& path,
                                              const std::vector<Point>& nodes) const {
  return arcs_on(from_, false, path, nodes);
}

std::vector<double> PairOutline::arcs_on_to(const smoother::OutlinePath& path,
                                            const std::vector<Point>& nodes) const {
  return arcs_on(to_, true, path, nodes);
}

Point PairOutline::on_from(double arc) const {
  const auto after = std::ranges::lower_bound(arcs_, arc);
  const auto i = std::min<std::ptrdiff_t>(after - arcs_.begin(), std::ssize(arcs_) - 1);
  const Point b = geometry_.point(from_.vertices[i]);
  if (i == 0 || arcs_[i] == arc) return b;
  const Point a = geometry_.point(from_.vertices[i - 1]);
  return a + ((arc - arcs_[i - 1]) / (arcs_[i] - arcs_[i - 1])) * (b - a);
}

bool PairOutline::kept_at(double arc) const {
  const auto at = std::ranges::lower_bound(arcs_, arc);
  if (at == arcs_.end() || *at != arc) return false;
  const std::ptrdiff_t i = at - arcs_.begin();
  return geometry_.kept(from_.vertices[i]) || geometry_.kept(to_.vertices[i]);
}

PairSides pair_sides(const Communicator& comm, const smoother::OutlinePath& path, const PairOutline& outline,
                     const PeriodicPair& pair, const Mesh& mesh) {
  PairSides sides;
  for (const auto& [name, line] : {std::pair(&pair.from, &sides.from), std::pair(&pair.to, &sides.to)}) {
    std::optional<BoundaryLine> found = line_of_boundary(comm, mesh, *name);
    if (!found)
      throw InputError(
          fmt::format("boundary '{}' of a [[pair]] is not one open line of the mesh; reduce "
                      "spacing.min",
                      *name));
    *line = std::move(*found);
  }
  std::ranges::reverse(sides.to.nodes);
  std::ranges::reverse(sides.to.points);
  std::ranges::reverse(sides.to.edges);
  sides.from_arcs = outline.arcs_on_from(path, sides.from.points);
  sides.to_arcs = outline.arcs_on_to(path, sides.to.points);
  for (const auto& [arcs, points] :
       {std::pair(&sides.from_arcs, &sides.from.points), std::pair(&sides.to_arcs, &sides.to.points)}) {
    if (arcs->front() != 0 || arcs->back() != outline.length())
      throw InputError(
          fmt::format("boundaries '{}' and '{}' of a [[pair]]: an end is no node of the mesh, "
                      "the nearest is at ({:.6g}, {:.6g}); reduce spacing.min",
                      pair.from, pair.to, arcs->front() != 0 ? points->front().x : points->back().x,
                      arcs->front() != 0 ? points->front().y : points->back().y));
  }
  return sides;
}

}  // namespace quadloop
