#include "mesher/geometry/curve.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "mesher/geometry/curve_parts.hpp"

namespace quadloop {

namespace {

/// A control point in homogeneous coordinates.
struct Pole {
  double x = 0, y = 0, weight = 1;
  Point point() const { return {x / weight, y / weight}; }
};

Pole between(const Pole& a, const Pole& b, double t) {
  const double s = 1 - t;
  return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.weight + t * b.weight};
}

/// The origin of control points in homogeneous coordinates: rounding errors follow the size of the curve, and
/// the reversed curve has the same ones.
Point origin_of(const CurvedSegment& segment) { return 0.5 * (segment.from + segment.to); }

/// The control points of a curve.
class Poles {
 public:
  explicit Poles(const CurvedSegment& segment) : weights_{segment.curve.weights} {
    const Point origin = origin_of(segment);
    add(segment.from - origin);
    for (const Point p : segment.curve.inner) add(p - origin);
    add(segment.to - origin);
  }
  std::span<Pole> all() { return {poles_.data(), count_}; }

 private:
  void add(Point p) {
    const double weight = weights_.empty() ? 1 : weights_[count_];
    poles_[count_++] = {weight * p.x, weight * p.y, weight};
  }

  std::span<const double> weights_;
  std::size_t count_ = 0;
  std::array<Pole, Curve::largest_degree + 1> poles_;
};

struct PointAndDerivative {
  Point point;
  Point derivative;  ///< by the parameter
  double parameter = 0;
};

/// De Casteljau's algorithm, which overwrites the poles (Farin, Curves and Surfaces for CAGD, chapters 4 and
/// 13).
PointAndDerivative evaluate(std::span<Pole> poles, double t) {
  const std::size_t degree = poles.size() - 1;
  for (std::size_t round = degree; round > 1; --round) {
    for (std::size_t i = 0; i < round; ++i) poles[i] = between(poles[i], poles[i + 1], t);
  }
  const Pole a = poles[0], b = poles[1], at = between(a, b, t);
  const double scale = double(degree) * a.weight * b.weight / (at.weight * at.weight);
  return {at.point(), scale * (b.point() - a.point()), t};
}

CurvedSegment segment_of(std::span<const Pole> poles, Point from, Point to, Point origin, const Curve& like) {
  CurvedSegment part{from, {{}, {}, like.spacing, like.interpolates}, to};
  for (std::size_t i = 1; i + 1 < poles.size(); ++i) part.curve.inner.push_back(origin + poles[i].point());
  if (like.weights.empty()) return part;
  for (const Pole& pole : poles) part.curve.weights.push_back(pole.weight);
  return part;
}

/// Control points without repeated ones.
std::vector<Point> control_polygon(const CurvedSegment& segment) {
  std::vector<Point> polygon{segment.from};
  const auto add = [&](Point p) {
    if (p != polygon.back()) polygon.push_back(p);
  };
  for (const Point p : segment.curve.inner) add(p);
  add(segment.to);
  return polygon;
}

Point unit_or_zero(Point p) {
  const double size = length(p);
  return size > 0 ? (1 / size) * p : Point{};
}

/// As above_chord(), relative to the origin, by an iteration that begins at the first end.
PointAndDerivative above_chord_from_start(const CurvedSegment& segment, Point p) {
  constexpr int most_steps = 24;
  const Poles poles(segment);
  const Point chord = segment.to - segment.from;
  const double wanted = dot(p - origin_of(segment), chord);
  double low = 0, high = 1, t = std::clamp(0.5 + wanted / dot(chord, chord), 0.0, 1.0);
  PointAndDerivative at;
  for (int step = 0; step < most_steps; ++step) {
    Poles work = poles;
    at = evaluate(work.all(), t);
    const double error = dot(at.point, chord) - wanted;
    (error > 0 ? high : low) = t;
    const double newton = t - error / dot(at.derivative, chord);
    if (newton == t) break;
    t = low < newton && newton < high ? newton : low + 0.5 * (high - low);
  }
  return at;
}

}  // namespace

std::pair<CurvedSegment, CurvedSegment> parts_at_parameter(const CurvedSegment& segment, double t) {
  Poles of_segment(segment);
  const std::span<Pole> poles = of_segment.all();
  std::vector<Pole> first{poles.front()}, second{poles.back()};
  for (std::size_t round = poles.size() - 1; round > 0; --round) {
    for (std::size_t i = 0; i < round; ++i) poles[i] = between(poles[i], poles[i + 1], t);
    first.push_back(poles.front());
    second.push_back(poles[round - 1]);
  }
  std::ranges::reverse(second);
  const Point origin = origin_of(segment), middle = origin + first.back().point();
  return {segment_of(first, segment.from, middle, origin, segment.curve),
          segment_of(second, middle, segment.to, origin, segment.curve)};
}

Curve reversed(Curve curve) {
  std::ranges::reverse(curve.inner);
  std::ranges::reverse(curve.weights);
  return curve;
}

CurvedSegment reversed(CurvedSegment segment) {
  return {segment.to, reversed(std::move(segment.curve)), segment.from};
}

Box box_of(const CurvedSegment& segment) {
  Box box = box_of(segment.from, segment.to);
  for (const Point p : segment.curve.inner) box.include(p);
  return box;
}

std::pair<CurvedSegment, CurvedSegment> halves(const CurvedSegment& segment) {
  return parts_at_parameter(segment, 0.5);
}

std::pair<CurvedSegment, CurvedSegment> parts_at(const CurvedSegment& segment, Point p) {
  const double forward = above_chord_from_start(segment, p).parameter,
               back = above_chord_from_start(reversed(segment), p).parameter;
  auto parts = parts_at_parameter(segment, 0.5 * (forward + (1 - back)));
  parts.first.to = parts.second.from = above_chord(segment, p).point;
  return parts;
}

Point point_at(const CurvedSegment& segment, double parameter) {
  Poles poles(segment);
  return origin_of(segment) + evaluate(poles.all(), parameter).point;
}

Point direction_at_start(const CurvedSegment& segment) {
  const std::vector<Point> polygon = control_polygon(segment);
  return polygon.size() < 2 ? Point{} : unit_or_zero(polygon[1] - polygon[0]);
}

Point direction_at_end(const CurvedSegment& segment) { return -1 * direction_at_start(reversed(segment)); }

double height_of_hull(const CurvedSegment& segment) {
  const Point along = unit_or_zero(segment.to - segment.from);
  double height = 0;
  for (const Point p : segment.curve.inner) {
    const Point from = p - segment.from, to = p - segment.to;
    const double beyond = std::max({0.0, -dot(from, along), dot(to, along)});
    height = std::max(height, std::hypot(beyond, cross(along, from)));
  }
  return height;
}

double turning_of_hull(const CurvedSegment& segment) {
  const std::vector<Point> polygon = control_polygon(segment);
  double turning = 0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Point in = polygon[i - 1] - polygon[i - 2], out = polygon[i] - polygon[i - 1];
    turning += std::abs(std::atan2(cross(in, out), dot(in, out)));
  }
  return turning * (180 / std::numbers::pi);
}

CurvePoint above_chord(const CurvedSegment& segment, Point p) {
  const Point chord = segment.to - segment.from;
  if (segment.curve.straight()) return {p, unit_or_zero(chord)};
  if (dot(p - segment.from, chord) <= 0) return {segment.from, direction_at_start(segment)};
  if (dot(p - segment.to, chord) >= 0) return {segment.to, direction_at_end(segment)};
  const PointAndDerivative forward = above_chord_from_start(segment, p),
                           back = above_chord_from_start(reversed(segment), p);
  return {origin_of(segment) + 0.5 * (forward.point + back.point),
          unit_or_zero(unit_or_zero(forward.derivative) - unit_or_zero(back.derivative))};
}

}  // namespace quadloop
