#include "mesher/geometry/assemble/curved_chain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace quadloop {

namespace {

/// A pole of a B-spline in homogeneous coordinates.
struct Pole {
  double x = 0, y = 0, weight = 1;
};

Pole blend(const Pole& a, const Pole& b, double t) {
  const double s = 1 - t;
  return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.weight + t * b.weight};
}

/// The B-spline's poles relative to its first one.
std::vector<Pole> poles_of(const BSpline& spline) {
  std::vector<Pole> poles;
  for (std::size_t i = 0; i < spline.poles.size(); ++i) {
    const double weight = spline.weights.empty() ? 1 : spline.weights[i];
    const Point p = spline.poles[i] - spline.poles.front();
    poles.push_back({weight * p.x, weight * p.y, weight});
  }
  return poles;
}

/// The blossom of the polynomial on the interval that begins with knot `span`, at `degree` arguments.
Pole blossom(const BSpline& spline, std::span<const Pole> poles, std::size_t span,
             std::span<const double> arguments) {
  const std::size_t degree = spline.degree, first = span - degree;
  std::vector<Pole> work(poles.begin() + first, poles.begin() + span + 1);
  for (std::size_t round = 1; round <= degree; ++round) {
    for (std::size_t j = degree; j >= round; --j) {
      const double low = spline.knots[first + j], high = spline.knots[span + 1 + j - round];
      work[j] = blend(work[j - 1], work[j], (arguments[round - 1] - low) / (high - low));
    }
  }
  return work[degree];
}

/// The Bézier poles of the interval that begins with knot `span`.
std::vector<Pole> bezier_poles(const BSpline& spline, std::span<const Pole> poles, std::size_t span) {
  const std::size_t degree = spline.degree;
  std::vector<double> arguments(degree, spline.knots[span]);
  std::vector<Pole> bezier;
  for (std::size_t j = 0; j <= degree; ++j) {
    bezier.push_back(blossom(spline, poles, span, arguments));
    if (j < degree) arguments[degree - 1 - j] = spline.knots[span + 1];
  }
  return bezier;
}

/// The intervals of different knots in the range where the B-spline is defined.
std::vector<std::size_t> spans_of(const BSpline& spline) {
  std::vector<std::size_t> spans;
  for (std::size_t i = spline.degree; i < spline.poles.size(); ++i) {
    if (spline.knots[i] < spline.knots[i + 1]) spans.push_back(i);
  }
  return spans;
}

Point point_of(const BSpline& spline, const Pole& pole) {
  return spline.poles.front() + Point{pole.x / pole.weight, pole.y / pole.weight};
}

/// Solves a tridiagonal system for points by elimination without pivoting.
std::vector<Point> solve_tridiagonal(const std::vector<double>& below, std::vector<double> diagonal,
                                     const std::vector<double>& above, std::vector<Point> right) {
  const std::size_t n = diagonal.size();
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = below[i] / diagonal[i - 1];
    diagonal[i] -= factor * above[i - 1];
    right[i] = right[i] - factor * right[i - 1];
  }
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) right[i] = right[i] - above[i] * right[i + 1];
    right[i] = (1 / diagonal[i]) * right[i];
  }
  return right;
}

/// First and last row of a system for the slopes of a cubic spline: the slope at the end and at the next
/// point, and the right side.
struct EndRow {
  double at_end = 1, at_next = 0;
  Point right;
};

/// `h`, `d`: length and slope of the end's interval; `next_h`, `next_d`: of the one beside it, if any.
EndRow end_row(std::optional<Point> direction, double h, Point d, std::optional<double> next_h, Point next_d,
               bool parabola) {
  if (direction) return {1, 0, *direction};
  if (!next_h) return {1, 0, d};
  if (parabola) return {1, 1, 2 * d};
  const double sum = h + *next_h;
  return {*next_h, sum, (1 / sum) * ((h + 2 * sum) * *next_h * d + h * h * next_d)};
}

/// The slopes at the points by the chord length (de Boor, A Practical Guide to Splines, chapter IV).
std::vector<Point> slopes_from_start(std::span<const Point> points, const EndDirections& directions) {
  const std::size_t n = points.size(), last = n - 1;
  std::vector<double> h, below(n), diagonal(n), above(n);
  std::vector<Point> d, right(n);
  for (std::size_t i = 0; i < last; ++i) {
    h.push_back(length(points[i + 1] - points[i]));
    d.push_back((1 / h[i]) * (points[i + 1] - points[i]));
  }
  const auto length_at = [&](std::size_t i) { return n > 2 ? std::optional(h[i]) : std::nullopt; };
  const std::size_t second = std::min<std::size_t>(1, last - 1), before = last >= 2 ? last - 2 : 0;
  const bool parabola = n == 3;
  const EndRow first = end_row(directions.start, h[0], d[0], length_at(second), d[second], parabola);
  const EndRow final =
      end_row(directions.end, h[last - 1], d[last - 1], length_at(before), d[before], parabola);
  diagonal[0] = first.at_end, above[0] = first.at_next, right[0] = first.right;
  for (std::size_t i = 1; i < last; ++i) {
    below[i] = h[i];
    diagonal[i] = 2 * (h[i - 1] + h[i]);
    above[i] = h[i - 1];
    right[i] = 3 * (h[i] * d[i - 1] + h[i - 1] * d[i]);
  }
  below[last] = final.at_next, diagonal[last] = final.at_end, right[last] = final.right;
  return solve_tridiagonal(below, std::move(diagonal), above, std::move(right));
}

double angle_between(Point a, Point b) { return std::abs(std::atan2(cross(a, b), dot(a, b))); }

Point mirrored_at(Point direction, Point p) {
  return (2 * dot(direction, p) / dot(direction, direction)) * direction - p;
}

/// Replaces slopes that swing out: at a point between two intervals that differ from one of their directions
/// by more than the polygon turns there and at both neighbours, by the slope of the parabola through the
/// three points; at an end that differ from its interval by more than twice the angle at the other side of
/// the interval, by the slope of a parabola. Points with rounded coordinates and uneven distances cause
/// these.
void limit_slopes(std::span<const Point> points, const EndDirections& directions,
                  std::vector<Point>& slopes) {
  const std::size_t last = points.size() - 1;
  const auto interval = [&](std::size_t i) { return points[i + 1] - points[i]; };
  std::vector<double> turns(points.size(), 0);
  for (std::size_t i = 1; i < last; ++i) turns[i] = angle_between(interval(i - 1), interval(i));
  const std::vector<Point> given = slopes;
  for (std::size_t i = 1; i < last; ++i) {
    const Point before = interval(i - 1), after = interval(i);
    const double most = turns[i - 1] + turns[i] + turns[i + 1];
    if (std::max(angle_between(before, given[i]), angle_between(after, given[i])) <= most) continue;
    const double h = length(before), k = length(after);
    slopes[i] = (1 / (h + k)) * ((k / h) * before + (h / k) * after);
  }
  const auto limit_end = [&](Point direction, Point beside, Point& slope) {
    if (angle_between(direction, slope) > 2 * angle_between(direction, beside))
      slope = mirrored_at(direction, beside);
  };
  if (last < 2) return;
  if (!directions.start) limit_end(interval(0), slopes[1], slopes[0]);
  if (!directions.end) limit_end(interval(last - 1), slopes[last - 1], slopes[last]);
}

/// The mean of the solutions from both ends, so that the reversed points have the reversed slopes, bit by
/// bit.
std::vector<Point> slopes_of(std::span<const Point> points, const EndDirections& directions) {
  const auto turned = [](std::optional<Point> p) { return p ? std::optional(-1 * *p) : std::nullopt; };
  const std::vector<Point> backwards(points.rbegin(), points.rend());
  std::vector<Point> slopes = slopes_from_start(points, directions);
  const std::vector<Point> back =
      slopes_from_start(backwards, {turned(directions.end), turned(directions.start)});
  for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = 0.5 * (slopes[i] - back[back.size() - 1 - i]);
  limit_slopes(points, directions, slopes);
  return slopes;
}

Curve hermite_curve(Point from, Point slope_from, Point to, Point slope_to) {
  const double h = length(to - from);
  return {{from + (h / 3) * slope_from, to - (h / 3) * slope_to}, {}, h, true};
}

/// Joins the points of a closed chain by a periodic cubic spline in the chord length.
void make_periodic_spline(Chain& chain) {
  // A slope depends on that of a point k places away by 0.27 to the power of k: 32 places are enough.
  constexpr std::size_t around = 32;
  const std::vector<Point>& points = chain.points;
  const std::size_t n = points.size();
  std::vector<Point> repeated;
  for (std::size_t i = 0; i < n + 2 * around; ++i) repeated.push_back(points[(i + around * (n - 1)) % n]);
  const std::vector<Point> slopes = slopes_of(repeated, {});
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    chain.curves.push_back(hermite_curve(points[i], slopes[around + i], points[j], slopes[around + j]));
  }
}

/// The corners of a chain: see join_by_splines(). The ends of an open chain are corners.
std::vector<std::size_t> corners_of(const Chain& chain, double corner_degrees) {
  constexpr double surely = 60, sharper_than_neighbours = 2;
  const std::vector<Point>& p = chain.points;
  const std::size_t n = p.size();
  std::vector<double> turns(n, 180);
  for (std::size_t i = chain.open ? 1 : 0; i + (chain.open ? 1 : 0) < n; ++i) {
    const Point in = p[i] - p[(i + n - 1) % n], out = p[(i + 1) % n] - p[i];
    turns[i] = std::abs(std::atan2(cross(in, out), dot(in, out))) * (180 / std::numbers::pi);
  }
  std::vector<std::size_t> corners;
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_end = chain.open && (i == 0 || i + 1 == n);
    const double beside = std::max(turns[(i + n - 1) % n], turns[(i + 1) % n]);
    const bool is_sharp = turns[i] > surely || turns[i] > sharper_than_neighbours * beside;
    if (is_end || (turns[i] > corner_degrees && is_sharp)) corners.push_back(i);
  }
  return corners;
}

std::optional<Point> unit(std::optional<Point> p) {
  return p ? std::optional((1 / length(*p)) * *p) : std::nullopt;
}

/// Extends the box by a curve, which is halved where its control points are outside.
void include(const CurvedSegment& segment, int halvings, Box& box) {
  box.include(segment.to);
  const auto is_outside = [&](Point p) {  // not one that is no number
    return p.x < box.low.x || p.x > box.high.x || p.y < box.low.y || p.y > box.high.y;
  };
  if (halvings == 0 || std::ranges::none_of(segment.curve.inner, is_outside)) return;
  const auto [first, second] = halves(segment);
  include(first, halvings - 1, box);
  include(second, halvings - 1, box);
}

}  // namespace

std::pair<std::int64_t, Point> drop_repeats(Chain& chain, double within) {
  std::vector<Point>& points = chain.points;
  const auto near = [&](Point a, Point b) {
    return std::abs(a.x - b.x) <= within && std::abs(a.y - b.y) <= within;
  };
  const auto repeated = std::adjacent_find(points.begin(), points.end(), near);
  const bool ends_at_start = !chain.open && points.size() > 1 && near(points.back(), points.front());
  if (repeated == points.end() && !ends_at_start) return {};
  const Point first = repeated == points.end() ? points.back() : *repeated, last = points.back();
  const std::size_t before = points.size();
  std::size_t kept = 1;
  for (std::size_t i = 1; i < before; ++i) {
    if (near(points[kept - 1], points[i])) continue;
    if (!chain.curves.empty()) chain.curves[kept - 1] = chain.curves[i - 1];
    points[kept++] = points[i];
  }
  if (!chain.curves.empty() && !chain.open) chain.curves[kept - 1] = chain.curves[before - 1];
  while (!chain.open && kept > 1 && near(points[kept - 1], points.front())) --kept;
  points.resize(kept);
  if (chain.open && kept == 1 && last != points.front()) points.push_back(last);
  if (chain.open) points.back() = last;
  if (!chain.curves.empty()) chain.curves.resize(chain.open ? points.size() - 1 : points.size());
  return {before - points.size(), first};
}

std::vector<Curve> reversed(std::vector<Curve> curves) {
  std::ranges::reverse(curves);
  for (Curve& curve : curves) curve = reversed(std::move(curve));
  return curves;
}

Box box_of(std::span<const Chain> chains) {
  constexpr int to_rounding = 26;  // each halving of a curve leaves a quarter of its height
  Box box;
  for (const Chain& chain : chains) {
    for (const Point p : chain.points) box.include(p);
  }
  for (const Chain& chain : chains) {
    for (std::size_t i = 0; i < chain.curves.size(); ++i)
      include({chain.points[i], chain.curves[i], chain.points[(i + 1) % chain.points.size()]}, to_rounding,
              box);
  }
  return box;
}

void append_segment(Chain& chain, Curve curve, Point to) {
  if (!curve.straight()) chain.curves.resize(chain.points.size() - 1);
  if (!curve.straight() || !chain.curves.empty()) chain.curves.push_back(std::move(curve));
  chain.points.push_back(to);
}

Point EllipticArc::point_at(double t) const { return centre + std::cos(t) * major + std::sin(t) * minor; }

void append_arc(Chain& chain, const EllipticArc& arc, std::optional<Point> to) {
  const double sweep = arc.end - arc.begin;
  const int pieces =
      std::max(1, static_cast<int>(std::ceil(std::abs(sweep) / (0.5 * std::numbers::pi) - 1e-9)));
  const double half = 0.5 * sweep / pieces;
  const Point end = to.value_or(arc.point_at(arc.end));
  for (int i = 0; i < pieces; ++i) {
    const double middle = arc.begin + (2 * i + 1) * half;
    const Point pole = arc.centre + (1 / std::cos(half)) * (arc.point_at(middle) - arc.centre);
    append_segment(chain, {{pole}, {1, std::cos(half), 1}},
                   i + 1 == pieces ? end : arc.point_at(arc.begin + 2 * (i + 1) * half));
  }
}

void append_bulge(Chain& chain, double bulge, Point to) {
  constexpr double of_right_angle = 0.4142135623730951;
  const Point from = chain.points.back(), middle = 0.5 * (from + to), chord = to - from,
              outward{chord.y, -chord.x};
  if (bulge == 0) return append_line(chain, to);
  if (std::abs(bulge) <= of_right_angle) {
    const double square = bulge * bulge;
    return append_segment(
        chain, {{middle + (bulge / (1 - square)) * outward}, {1, (1 - square) / (1 + square), 1}}, to);
  }
  const double of_half = (std::hypot(1, bulge) - 1) / bulge;
  append_bulge(chain, of_half, middle + (0.5 * bulge) * outward);
  append_bulge(chain, of_half, to);
}

std::string fault_of(const BSpline& spline) {
  constexpr int largest_degree = Curve::largest_degree;
  const std::size_t poles = spline.poles.size();
  if (spline.degree < 1 || spline.degree > largest_degree)
    return fmt::format("its degree is {}, but degrees from 1 to {} are read", spline.degree, largest_degree);
  const std::size_t degree = spline.degree;
  if (poles < degree + 1)
    return fmt::format("it has {} control points, but its degree {} needs {}", poles, degree, degree + 1);
  if (spline.knots.size() != poles + degree + 1)
    return fmt::format("it has {} knots, but {} control points of degree {} need {}", spline.knots.size(),
                       poles, degree, poles + degree + 1);
  if (!spline.weights.empty() && spline.weights.size() != poles)
    return fmt::format("it has {} weights, but {} control points", spline.weights.size(), poles);
  const auto finite = [](double value) { return std::isfinite(value); };
  if (!std::ranges::all_of(spline.knots, finite) || !std::ranges::is_sorted(spline.knots))
    return "its knots are not in ascending order";
  if (!(spline.knots[degree] < spline.knots[poles])) return "its knots span no range";
  if (!std::ranges::all_of(spline.weights, [&](double w) { return finite(w) && w > 0; }))
    return "a weight is not positive";
  if (!std::ranges::all_of(spline.poles, [&](Point p) { return finite(p.x) && finite(p.y); }))
    return "a control point is not finite";
  return {};
}

Point start_of(const BSpline& spline) {
  const std::size_t first = spans_of(spline).front();
  return point_of(spline, bezier_poles(spline, poles_of(spline), first).front());
}

void append_bspline(Chain& chain, const BSpline& spline) {
  const std::vector<Pole> poles = poles_of(spline);
  for (const std::size_t span : spans_of(spline)) {
    const std::vector<Pole> bezier = bezier_poles(spline, poles, span);
    Curve curve;
    for (std::size_t i = 1; i + 1 < bezier.size(); ++i) curve.inner.push_back(point_of(spline, bezier[i]));
    if (!spline.weights.empty()) {
      for (const Pole& pole : bezier) curve.weights.push_back(pole.weight);
    }
    append_segment(chain, std::move(curve), point_of(spline, bezier.back()));
  }
}

void append_spline(Chain& chain, std::span<const Point> points, const EndDirections& directions) {
  std::vector<Point> through{chain.points.back()};
  through.insert(through.end(), points.begin(), points.end());
  if (through.size() == 2 && !directions.start && !directions.end) return append_line(chain, through[1]);
  const std::vector<Point> slopes = slopes_of(through, {unit(directions.start), unit(directions.end)});
  for (std::size_t i = 1; i < through.size(); ++i)
    append_segment(chain, hermite_curve(through[i - 1], slopes[i - 1], through[i], slopes[i]), through[i]);
}

void join_by_splines(Chain& chain, double corner_degrees) {
  drop_repeats(chain, 0);
  const std::size_t n = chain.points.size();
  if (n < 3) return;
  const std::vector<std::size_t> corners = corners_of(chain, corner_degrees);
  if (corners.empty()) return make_periodic_spline(chain);
  const auto at = [&](std::size_t i) { return chain.points[i % n]; };
  Chain joined{chain.name, true, {at(corners.front())}, chain.source, chain.directed};
  for (std::size_t c = 0; c + (chain.open ? 1 : 0) < corners.size(); ++c) {
    const std::size_t end = c + 1 < corners.size() ? corners[c + 1] : corners.front() + n;
    std::vector<Point> through;
    for (std::size_t i = corners[c] + 1; i <= end; ++i) through.push_back(at(i));
    append_spline(joined, through);
  }
  joined.open = chain.open;
  if (!chain.open) joined.points.pop_back();
  chain = std::move(joined);
}

}  // namespace quadloop
