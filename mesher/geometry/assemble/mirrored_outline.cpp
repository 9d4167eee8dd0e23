#include "mesher/geometry/assemble/mirrored_outline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesher/base/counted.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/id_vector.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"
#include "mesher/geometry/assemble/mirrored_curves.hpp"

namespace quadloop {

namespace {

/// Largest distance of control points of a curve from those of its image, as a fraction of the extent.
constexpr double curve_rounding = 1e-9;

double gap(Point a, Point b) { return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)); }

/// The points on one side of the axis, mirrored if necessary, all with positive heights.
class PointsAbove {
 public:
  PointsAbove(std::vector<Point> points, double tolerance)
      : points_{std::move(points)}, tolerance_{tolerance} {
    std::sort(points_.begin(), points_.end());
  }

  /// The point at this place, or the nearest one within the tolerance; null if there is none.
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

/// Advice if the image of the point in the centre line of the chains' bounding box is one of their points:
/// the geometry may be symmetric about that line instead.
std::string advice_beside_axis(const std::vector<Chain>& chains, Point p, MirrorAxis axis, const Box& box) {
  const double middle = height_over(axis, box.centre()), size = std::max(box.width(), box.height());
  if (std::abs(middle) <= mirror_rounding * size) return {};
  const Point shift = axis == MirrorAxis::x ? Point{0, 2 * middle} : Point{2 * middle, 0};
  const Point image = image_of(axis, p) + shift;
  const auto has_it = [&](const Chain& chain) {
    return std::ranges::any_of(chain.points, [&](Point q) { return gap(q, image) <= 1e-6 * size; });
  };
  if (std::ranges::none_of(chains, has_it)) return {};
  return fmt::format("; its line of symmetry is at {} = {:.17g}: move it onto the axis by geometry.translate",
                     axis == MirrorAxis::x ? "y" : "x", middle);
}

[[noreturn]] void refuse_point(const std::vector<Chain>& chains, const Chain& chain, Point p, MirrorAxis axis,
                               const Box& box) {
  const Point image = image_of(axis, p);
  double nearest = std::numeric_limits<double>::infinity();
  for (const Chain& other : chains)
    for (const Point q : other.points) nearest = std::min(nearest, length(q - image));
  throw InputError(fmt::format(
      "{}: boundary {}: the point ({}, {}) has no mirror image at ({}, {}), which mesh.mirror = \"{}\" "
      "requires; the nearest point is {:.3g} away; make the geometry symmetric, or remove the key{}",
      chain.source, chain.name, p.x, p.y, image.x, image.y, name_of(axis), nearest,
      advice_beside_axis(chains, p, axis, box)));
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
      if (is_on_axis(p)) move(p, foot_on(axis, p));
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
      if (image == nullptr) refuse_point(chains, chain, p, axis, box);
      if (side < 0) move(p, image_of(axis, *image));
    }
  }
  fit_curves_to_mirror(chains, axis, curve_rounding * std::max(box.width(), box.height()));
  if (moved > 0) {
    warnings.push_back(fmt::format(
        "moved {} of the geometry by a rounding error, onto mirror images of others about the {}-axis "
        "or onto it",
        counted(moved, "point"), name_of(axis)));
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
      "boundary {}: {} the part from ({}, {}) to ({}, {}) about the {}-axis, but mesh.mirror requires a "
      "symmetric geometry; make it symmetric, or remove the key",
      geometry.boundary(s.boundary).name, fault, s.from.x, s.from.y, s.to.x, s.to.y, name_of(axis)));
}

}  // namespace

IdVector<BoundaryId, BoundaryId> require_mirror_images(const Geometry& geometry, MirrorAxis axis) {
  const std::vector<Segment> segments = segments_by_ends(geometry);
  IdVector<BoundaryId, BoundaryId> image_of_boundary(geometry.boundaries().size());
  for (const Segment& s : segments) {
    const std::pair wanted{image_of(axis, s.to), image_of(axis, s.from)};  // with the domain to its left
    const auto image = std::lower_bound(segments.begin(), segments.end(), wanted,
                                        [](const Segment& t, const auto& ends) { return t.ends() < ends; });
    if (image == segments.end() || image->ends() != wanted)
      refuse_segment(geometry, s, axis, "there is no mirror image of");
    BoundaryId& known = image_of_boundary[s.boundary];
    if (!known.valid()) known = image->boundary;
    if (known != image->boundary)
      refuse_segment(geometry, s, axis,
                     fmt::format("its mirror image belongs to two boundaries; '{}' has that of",
                                 geometry.boundary(image->boundary).name));
    if (!asks_for_the_same(geometry.boundary(s.boundary), geometry.boundary(image->boundary)))
      refuse_segment(geometry, s, axis,
                     fmt::format("'{}', with another spacing, corner or other layers, is the mirror image of",
                                 geometry.boundary(image->boundary).name));
  }
  return image_of_boundary;
}

namespace {

/// The parts of the geometry above the axis, each on one boundary; open parts begin and end on the axis or at
/// the next part.
std::vector<Chain> parts_above(const Geometry& geometry, MirrorAxis axis) {
  std::vector<Chain> parts;
  for (std::int32_t s = 0; s < geometry.size(); ++s) {
    Point from = geometry.point(s), to = geometry.point(geometry.next(s));
    if (side_of(axis, from) <= 0 && side_of(axis, to) <= 0) continue;
    Curve curve = geometry.curve(s);
    if (side_of(axis, from) < 0 || side_of(axis, to) < 0) {  // its own image: at a right angle to the axis
      const auto [first, second] = halves(geometry.segment(s));
      const bool begins_above = side_of(axis, from) > 0;
      curve = begins_above ? first.curve : second.curve;
      (begins_above ? to : from) = foot_on(axis, first.to);
    }
    const std::string& name = geometry.boundary(geometry.boundary_of(s)).name;
    const bool goes_on = !parts.empty() && parts.back().name == name && parts.back().points.back() == from &&
                         geometry.previous(s) == s - 1;
    if (!goes_on) parts.push_back({name, true, {from}, "half of the outline"});
    append_segment(parts.back(), std::move(curve), to);
  }
  for (Chain& part : parts) {
    part.open = part.points.front() != part.points.back();
    if (!part.open) part.points.pop_back();
  }
  return parts;
}

}  // namespace

std::vector<Chain> half_outline(const Geometry& geometry, MirrorAxis axis, const std::string& name) {
  std::vector<Chain> chains = parts_above(geometry, axis);
  struct Meeting {
    double along;  ///< direction along the axis with the domain above to the left
    Point point;
    bool leaves;  ///< the part leaves the axis here
  };
  std::vector<Meeting> meetings;
  const auto add = [&](Point p, bool leaves) {
    if (side_of(axis, p) == 0) meetings.push_back({axis == MirrorAxis::x ? p.x : -p.y, p, leaves});
  };
  for (const Chain& chain : chains) {
    if (!chain.open) continue;
    add(chain.points.front(), true);
    add(chain.points.back(), false);
  }
  std::ranges::sort(meetings, {}, [](const Meeting& m) { return std::pair{m.along, m.leaves}; });
  for (std::size_t i = 0; i + 1 < meetings.size(); ++i) {
    if (meetings[i].leaves || !meetings[i + 1].leaves) continue;
    chains.push_back({name, true, {meetings[i].point, meetings[i + 1].point}, "the mirror axis"});
  }
  return chains;
}

}  // namespace quadloop
