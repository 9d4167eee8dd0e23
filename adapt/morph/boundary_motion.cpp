#include "adapt/morph/boundary_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapt/morph/outline_map.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

/// Where each vertex of the mesh's outline goes, its own outline being what is known of the old one.
std::vector<Point> images_by_mesh(const Geometry& outline, const OutlineChange& change) {
  const Geometry to = walked_as(outline, change.to);
  const OutlineMap map(outline, to, false, {change.file, "the mesh"});
  const OutlinePath path(outline);
  std::vector<Point> images;
  for (std::int32_t v = 0; v < outline.size(); ++v) {
    const std::int32_t loop = outline.loop_of(v);
    images.push_back(map.maps(loop) ? map.image(loop, path.arc_of(v)) : outline.point(v));
  }
  return images;
}

std::vector<Point> images_by_outline(const Geometry& outline, const OutlineChange& change) {
  const Geometry from = walked_as(outline, *change.from), to = walked_as(outline, change.to);
  const OutlineMap map(from, to, true, {change.file, change.from_file});
  const OutlinePath path(from);
  std::vector<Point> images;
  for (std::int32_t v = 0; v < outline.size(); ++v) {
    const Point p = outline.point(v);
    const std::string& name = outline.boundary(outline.boundary_of(v)).name;
    images.push_back(p);
    if (!path.has(name)) continue;
    const OutlinePlace place = path.locate(p, name, true);
    if (!place.valid())
      throw InputError(
          fmt::format("{}: the mesh's node ({:.12g}, {:.12g}) is not on boundary '{}' of this "
                      "outline; leave --from out, or give the outline that `quadloop mesh "
                      "--geometry-out` wrote",
                      change.from_file, p.x, p.y, name));
    if (map.maps(place.loop)) images.back() = map.image(place.loop, place.arc);
  }
  return images;
}

/// A node that the boundary passes twice stands for one place of the new outline too.
std::vector<BoundaryNodeMotion> each_once(std::vector<BoundaryNodeMotion> motions, const std::string& file) {
  constexpr double rounding = 1e-9;
  for (std::size_t k = 1; k < motions.size(); ++k) {
    const RigidMotion &one = motions[k - 1].motion, &other = motions[k].motion;
    if (motions[k].node != motions[k - 1].node || length(other.to - one.to) <= rounding * motions[k].width)
      continue;
    throw InputError(
        fmt::format("{}: the mesh's boundary passes the node ({:g}, {:g}) twice, where the new outline "
                    "parts; mesh that anew",
                    file, one.from.x, one.from.y));
  }
  const auto again = std::ranges::unique(motions, {}, &BoundaryNodeMotion::node);
  motions.erase(again.begin(), again.end());
  return motions;
}

double angle_between(Point before, Point after) {
  return std::atan2(cross(before, after), dot(before, after));
}

}  // namespace

Point RigidMotion::moved(Point p) const {
  const double sine = std::sin(angle), half = std::sin(angle / 2), versed = 2 * half * half;  // 1 - cosine
  const Point arm = p - from;
  return p + (to - from) + Point{-versed * arm.x - sine * arm.y, sine * arm.x - versed * arm.y};
}

std::vector<BoundaryNodeMotion> boundary_motion(const BoundaryOutline& outline, const OutlineChange& change) {
  const Geometry& before = outline.geometry;
  const std::vector<Point> after =
      change.from == nullptr ? images_by_mesh(before, change) : images_by_outline(before, change);
  const auto edge = [&](std::int32_t v) { return before.point(before.next(v)) - before.point(v); };
  const auto turn = [&](std::int32_t v) { return angle_between(edge(v), after[before.next(v)] - after[v]); };
  std::vector<BoundaryNodeMotion> motions;
  for (std::int32_t v = 0; v < before.size(); ++v) {
    const std::int32_t previous = before.previous(v);
    motions.push_back({outline.nodes[v],
                       {before.point(v), after[v], (turn(previous) + turn(v)) / 2},
                       (length(edge(previous)) + length(edge(v))) / 2});
  }
  std::ranges::stable_sort(motions, {}, &BoundaryNodeMotion::node);
  return each_once(std::move(motions), change.file);
}

}  // namespace quadloop
