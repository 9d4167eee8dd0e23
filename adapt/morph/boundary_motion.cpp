#include "adapt/morph/boundary_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapt/morph/merged_bases.hpp"
#include "adapt/morph/outline_map.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::adapt {

namespace {

/// Returns the image of each vertex of the mesh boundary, if the mesh boundary is all that is known of the
/// old geometry.
std::vector<Point> images_by_mesh(const Geometry& outline, const OutlineChange& change) {
  const Geometry to = with_bases_as_in(outline, walked_as(outline, change.to));
  const OutlineMap map(outline, to, false, {change.file, "the mesh"});
  const smoother::OutlinePath path(outline);
  std::vector<Point> images;
  for (std::int32_t v = 0; v < outline.size(); ++v) {
    const std::int32_t loop = outline.loop_of(v);
    images.push_back(map.maps(loop) ? map.image(loop, path.arc_of(v)) : outline.point(v));
  }
  return images;
}

/// Positions of the vertices of a mesh boundary on the geometry that the mesh was made for.
class PlacesOnOutline {
 public:
  PlacesOnOutline(const Geometry& outline, const OutlineChange& change)
      : outline_{outline},
        change_{change},
        from_{change.by_pieces ? *change.from : walked_as(outline, *change.from)},
        path_{from_} {}

  const Geometry& from() const { return from_; }

  /// Invalid if that geometry lacks the boundary.
  smoother::OutlinePlace of(std::int32_t v) const {
    const Point p = outline_.point(v);
    const std::string& name = outline_.boundary(outline_.boundary_of(v)).name;
    if (!path_.has(name)) return {};
    const smoother::OutlinePlace place = path_.locate(p, name);
    if (place.valid()) return place;
    throw InputError(
        fmt::format("{}: the mesh's node ({:.12g}, {:.12g}) is not on boundary '{}' of this geometry; omit "
                    "--from, or give the geometry that `quadloop mesh --geometry-out` wrote",
                    change_.from_file, p.x, p.y, name));
  }

 private:
  const Geometry& outline_;
  const OutlineChange& change_;
  Geometry from_;
  smoother::OutlinePath path_;
};

std::vector<Point> images_by_outline(const Geometry& outline, const OutlineChange& change) {
  const PlacesOnOutline places(outline, change);
  const Geometry to = change.by_pieces ? change.to : walked_as(outline, change.to);
  const OutlineMap map = change.by_pieces
                             ? OutlineMap(places.from(), to)
                             : OutlineMap(places.from(), to, true, {change.file, change.from_file});
  std::vector<Point> images;
  for (std::int32_t v = 0; v < outline.size(); ++v) {
    const smoother::OutlinePlace place = places.of(v);
    const bool stays = !place.valid() || !map.maps(place.loop);
    images.push_back(stays ? outline.point(v) : map.image(place.loop, place.arc));
  }
  return images;
}

/// Converts vertices of walked_as(like, outline) to vertices of the outline itself.
std::vector<std::int32_t> vertices_as_given(const Geometry& like, const Geometry& outline) {
  const std::vector<char> against = loops_against(like, outline);
  std::vector<std::int32_t> given(outline.size());
  for (std::int32_t v = 0; v < outline.size(); ++v) {
    const std::int32_t loop = outline.loop_of(v), begin = outline.loop_start(loop);
    given[v] = against[loop] == 0 || v == begin ? v : begin + outline.loop_start(loop + 1) - v;
  }
  return given;
}

[[noreturn]] void refuse_shares(const OutlineChange& change) {
  throw InputError(
      fmt::format("{}: derivatives with respect to its points require the geometry on which the mesh was "
                  "made, with as many points; give that as --from",
                  change.file));
}

/// Requires that a node where the boundary passes twice has a single image on the new geometry.
std::vector<BoundaryNodeMotion> each_once(std::vector<BoundaryNodeMotion> motions, const std::string& file) {
  constexpr double rounding = 1e-9;
  for (std::size_t k = 1; k < motions.size(); ++k) {
    const RigidMotion &one = motions[k - 1].motion, &other = motions[k].motion;
    if (motions[k].node != motions[k - 1].node || length(other.to - one.to) <= rounding * motions[k].width)
      continue;
    throw InputError(
        fmt::format("{}: the boundary of the mesh passes the node ({:g}, {:g}) twice, where the new geometry "
                    "separates; generate a new mesh",
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

std::vector<Point> images_of(const BoundaryOutline& outline, const OutlineChange& change) {
  const Geometry& before = outline.geometry;
  return change.from == nullptr ? images_by_mesh(before, change) : images_by_outline(before, change);
}

std::vector<PointShares> image_shares(const BoundaryOutline& outline, const OutlineChange& change) {
  if (change.from == nullptr) refuse_shares(change);
  if (change.by_pieces)
    throw InputError(change.file +
                     ": derivatives with respect to its points require a mesh without inner lines, and "
                     "without blocks that touch its boundary");
  const Geometry& before = outline.geometry;
  const PlacesOnOutline places(before, change);
  const Geometry to = walked_as(before, change.to);
  const OutlineMap map(places.from(), to, true, {change.file, change.from_file});
  const std::vector<std::int32_t> given = vertices_as_given(before, change.to);
  std::vector<PointShares> all;
  for (std::int32_t v = 0; v < before.size(); ++v) {
    all.emplace_back();
    const smoother::OutlinePlace place = places.of(v);
    if (!place.valid() || !map.maps(place.loop)) continue;
    const auto shares = map.shares(place.loop, place.arc);
    if (!shares) refuse_shares(change);
    all.back() = {given[shares->first], given[shares->second], shares->share};
  }
  return all;
}

std::vector<BoundaryNodeMotion> boundary_motion(const BoundaryOutline& outline, const OutlineChange& change) {
  const Geometry& before = outline.geometry;
  const std::vector<Point> after = images_of(outline, change);
  const auto edge = [&](std::int32_t v) { return before.point(before.next(v)) - before.point(v); };
  const auto turn = [&](std::int32_t v) { return angle_between(edge(v), after[before.next(v)] - after[v]); };
  std::vector<BoundaryNodeMotion> motions;
  for (std::int32_t v = 0; v < before.size(); ++v) {
    const std::int32_t previous = before.previous(v);
    motions.push_back({outline.nodes[v],
                       {before.point(v), after[v], (turn(previous) + turn(v)) / 2},
                       (length(edge(previous)) + length(edge(v))) / 2,
                       v});
  }
  std::ranges::stable_sort(motions, {}, &BoundaryNodeMotion::node);
  return each_once(std::move(motions), change.file);
}

}  // namespace quadloop::adapt
