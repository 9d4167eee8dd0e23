#include "mesher/geometry/assemble/mirrored_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/base/id_vector.hpp"

namespace quadloop {

namespace {

double gap(Point a, Point b) { return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)); }

/// The points on one side of the axis, mirrored or not, all with heights above 0.
class PointsAbove {
 public:
  PointsAbove(std::vector<Point> points, double tolerance)
      : points_{std::move(points)}, tolerance_{tolerance} {
    std::sort(points_.begin(), points_.end());
  }

  /// The one at a place, or the nearest one within the tolerance; null where there is none.
  const Point* find(Point p) const {
    const auto same = std::lower_bound(points_.begin(), points_.end(), p);
    if (same != points_.end() && *same == p) return &*same;
    const Point low{p.x - tolerance_, p.y - tolerance_};
    const Point* nearest = nullptr;
    for (auto at = std::lower_bound(points_.begin(), points_.end(), low);
         at != points_.end() && at->x <= p.x + tolerance_; ++at) {
      if (gap(*at, p) <= (nearest != nullptr ? gap(*nearest, p) : tolerance_)) nearest = &*at;
    }
    return nearest;
  }

  /// Of all of them; infinite where there are none.
  double distance(Point p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Point q : points_) least = std::min(least, length(q - p));
    return least;
  }

 private:
  std::vector<Point> points_;
  double tolerance_;
};

PointsAbove points_above(const std::vector<Chain>& chains, MirrorAxis axis, int side, double tolerance) {
  std::vector<Point> points;
  for (const Chain& chain : chains) {
    for (const Point p : chain.points) {
      if (side_of(axis, p) == side) points.push_back(side > 0 ? p : image_of(axis, p));
    }
  }
  return {std::move(points), tolerance};
}

void refuse_point(const Chain& chain, Point p, MirrorAxis axis, const PointsAbove& others, const Box& box) {
  const Point image = image_of(axis, p);
  const double middle = height_over(axis, box.centre());
  const std::string moved =
      std::abs(middle) <= mirror_rounding * std::max(box.width(), box.height())
          ? ""
          : fmt::format("; the outline's middle is at {} = {:g}: geometry.translate moves it onto the axis",
                        axis == MirrorAxis::x ? "y" : "x", middle);
  throw InputError(
      fmt::format("{}: boundary {}: the point ({}, {}) has no mirror image at ({}, {}), where mesh.mirror = "
                  "\"{}\" wants one; the nearest point is {:.3g} away; make the outline symmetric, or take "
                  "the key out{}",
                  chain.source, chain.name, p.x, p.y, image.x, image.y, name_of(axis),
                  others.distance(side_of(axis, p) > 0 ? p : image), moved));
}

Box box_of(const std::vector<Chain>& chains) {
  Box box;
  for (const Chain& chain : chains) {
    for (const Point p : chain.points) box.include(p);
  }
  return box;
}

}  // namespace

void fit_to_mirror(std::vector<Chain>& chains, MirrorAxis axis, Warnings& warnings) {
  const Box box = box_of(chains);
  const double tolerance = mirror_rounding * std::max(box.width(), box.height());
  const auto is_on_axis = [&](Point p) { return std::abs(height_over(axis, p)) <= tolerance; };
  std::int64_t moved = 0;
  const auto move = [&](Point& p, Point to) {
    if (p != to) ++moved;
    p = to;
  };
  for (Chain& chain : chains) {
    for (Point& p : chain.points) {
      if (is_on_axis(p)) move(p, axis == MirrorAxis::x ? Point{p.x, 0} : Point{0, p.y});
    }
  }
  const PointsAbove above = points_above(chains, axis, 1, tolerance),
                    below = points_above(chains, axis, -1, tolerance);
  for (Chain& chain : chains) {
    for (Point& p : chain.points) {
      const int side = side_of(axis, p);
      if (side == 0) continue;
      const PointsAbove& others = side > 0 ? below : above;
      const Point* image = others.find(side > 0 ? p : image_of(axis, p));
      if (image == nullptr) refuse_point(chain, p, axis, others, box);
      if (side < 0) move(p, image_of(axis, *image));
    }
  }
  if (moved > 0) {
    warnings.push_back(
        fmt::format("{} points of the outline moved by rounding, onto the mirror images of others in the "
                    "{}-axis or onto it",
                    moved, name_of(axis)));
  }
}

namespace {

bool asks_for_the_same(const Boundary& a, const Boundary& b) {
  return a.spacing == b.spacing && a.corner_degrees == b.corner_degrees &&
         a.corner_spacing == b.corner_spacing && a.layers == b.layers;
}

struct Segment {
  Point from, to;
  BoundaryId boundary;
  auto ends() const { return std::pair{from, to}; }
};

std::vector<Segment> segments_by_ends(const Geometry& geometry) {
  std::vector<Segment> segments;
  for (std::int32_t s = 0; s < geometry.size(); ++s)
    segments.push_back({geometry.point(s), geometry.point(geometry.next(s)), geometry.boundary_of(s)});
  std::sort(segments.begin(), segments.end(),
            [](const Segment& a, const Segment& b) { return a.ends() < b.ends(); });
  return segments;
}

[[noreturn]] void refuse_segment(const Geometry& geometry, const Segment& s, MirrorAxis axis,
                                 const std::string& fault) {
  throw InputError(fmt::format(
      "boundary {}: {} the part from ({}, {}) to ({}, {}) in the {}-axis, where mesh.mirror "
      "wants the whole outline mirrored; make it symmetric, or take the key out",
      geometry.boundary(s.boundary).name, fault, s.from.x, s.from.y, s.to.x, s.to.y, name_of(axis)));
}

}  // namespace

void require_mirror_images(const Geometry& geometry, MirrorAxis axis) {
  const std::vector<Segment> segments = segments_by_ends(geometry);
  IdVector<BoundaryId, BoundaryId> image_of_boundary(geometry.boundaries().size());
  for (const Segment& s : segments) {
    const std::pair wanted{image_of(axis, s.to), image_of(axis, s.from)};  // the domain to its left
    const auto image = std::lower_bound(segments.begin(), segments.end(), wanted,
                                        [](const Segment& t, const auto& ends) { return t.ends() < ends; });
    if (image == segments.end() || image->ends() != wanted)
      refuse_segment(geometry, s, axis, "there is no mirror image of");
    BoundaryId& known = image_of_boundary[s.boundary];
    if (!known.valid()) known = image->boundary;
    if (known != image->boundary)
      refuse_segment(geometry, s, axis,
                     fmt::format("'{}' and another boundary hold the mirror images of it; one is that of",
                                 geometry.boundary(image->boundary).name));
    if (!asks_for_the_same(geometry.boundary(s.boundary), geometry.boundary(image->boundary)))
      refuse_segment(
          geometry, s, axis,
          fmt::format("'{}', which asks for another spacing, corner or other layers, is the mirror "
                      "image of",
                      geometry.boundary(image->boundary).name));
  }
}

}  // namespace quadloop
