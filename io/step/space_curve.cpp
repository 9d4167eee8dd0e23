#include "io/step/space_curve.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

#include "mesher/geometry/assemble/curved_chain.hpp"

namespace quadloop::io {

namespace {

/// A pole in homogeneous coordinates.
struct Pole {
  SpacePoint p;
  double weight = 1;
};

Pole blend(const Pole& a, const Pole& b, double t) {
  return {(1 - t) * a.p + t * b.p, (1 - t) * a.weight + t * b.weight};
}

Pole pole_of(const SpaceSpline& spline, std::size_t i) {
  const double weight = spline.weights.empty() ? 1 : spline.weights[i];
  return {weight * (spline.poles[i] - spline.poles.front()), weight};
}

SpacePoint point_of_pole(const SpaceSpline& spline, const Pole& pole) {
  return spline.poles.front() + (1 / pole.weight) * pole.p;
}

/// The index of the knot that begins the interval of t; the last interval is closed.
std::size_t span_of(const SpaceSpline& spline, double t) {
  const auto first = spline.knots.begin() + spline.degree, last = spline.knots.begin() + spline.poles.size();
  auto above = std::upper_bound(first, last, t);
  if (above == last) above = std::lower_bound(first, last, *last);
  return std::max(above, first + 1) - spline.knots.begin() - 1;
}

/// Inserts a knot within the range once. Poles behind the range, which are not used, stay as they are.
void insert_knot(SpaceSpline& spline, double t) {
  const std::size_t degree = spline.degree, last = spline.poles.size() - 1;
  const std::size_t span = std::ranges::upper_bound(spline.knots, t) - spline.knots.begin() - 1;
  std::vector<Pole> changed;
  for (std::size_t i = span - degree + 1; i <= span; ++i) {
    const double low = spline.knots[i], high = spline.knots[i + degree];
    const double share = high > low ? (t - low) / (high - low) : 0;
    changed.push_back(
        blend(pole_of(spline, std::min(i - 1, last)), pole_of(spline, std::min(i, last)), share));
  }
  const SpacePoint origin = spline.poles.front();
  spline.poles.insert(spline.poles.begin() + span - degree + 1, SpacePoint());
  if (!spline.weights.empty()) spline.weights.insert(spline.weights.begin() + span - degree + 1, 1);
  for (std::size_t j = 0; j < changed.size() && span - degree + 1 + j < spline.poles.size(); ++j) {
    const std::size_t i = span - degree + 1 + j;
    spline.poles[i] = origin + (1 / changed[j].weight) * changed[j].p;
    if (!spline.weights.empty()) spline.weights[i] = changed[j].weight;
  }
  spline.knots.insert(spline.knots.begin() + span + 1, t);
}

void raise_multiplicity(SpaceSpline& spline, double t) {
  for (auto count = std::ranges::count(spline.knots, t); count < spline.degree; ++count)
    insert_knot(spline, t);
}

/// The parameter itself, or a knot that differs from it by rounding.
double at_knot(const SpaceSpline& spline, double t) {
  const double rounding = 1e-12 * (spline.end() - spline.begin());
  const auto above = std::ranges::lower_bound(spline.knots, t);
  if (above != spline.knots.end() && *above - t <= rounding) return *above;
  if (above != spline.knots.begin() && t - above[-1] <= rounding) return above[-1];
  return t;
}

double distance_at(const SpaceSpline& spline, double t, const SpacePoint& p) {
  return length(spline.point_at(t) - p);
}

/// The parameter of the smallest distance between two parameters, by golden section.
double refined(const SpaceSpline& spline, double low, double high, const SpacePoint& p) {
  constexpr int steps = 80;
  constexpr double ratio = 0.6180339887498949;
  double left = high - ratio * (high - low), right = low + ratio * (high - low);
  double at_left = distance_at(spline, left, p), at_right = distance_at(spline, right, p);
  for (int i = 0; i < steps; ++i) {
    if (at_left < at_right) {
      high = std::exchange(right, left), at_right = at_left;
      left = high - ratio * (high - low), at_left = distance_at(spline, left, p);
    } else {
      low = std::exchange(left, right), at_left = at_right;
      right = low + ratio * (high - low), at_right = distance_at(spline, right, p);
    }
  }
  return at_left < at_right ? left : right;
}

/// The distance of p from the box of the control points of an interval, which contains the curve there.
double distance_of_box(const SpaceSpline& spline, std::size_t span, const SpacePoint& p) {
  SpacePoint outside;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto first = spline.poles.begin() + span - spline.degree;
    const auto [least, most] = std::minmax_element(
        first, first + spline.degree + 1,
        [axis](const SpacePoint& a, const SpacePoint& b) { return a.at[axis] < b.at[axis]; });
    outside.at[axis] = std::max({least->at[axis] - p.at[axis], p.at[axis] - most->at[axis], 0.0});
  }
  return length(outside);
}

/// A parameter, and the distance of its point from another one.
struct Nearest {
  double parameter = 0, distance = std::numeric_limits<double>::infinity();

  void take(const SpaceSpline& spline, double t, const SpacePoint& p) {
    if (const double d = distance_at(spline, t, p); d < distance) *this = {t, d};
  }
};

/// The nearest point within the interval that begins with knot `span`: samples, and a search about each
/// sample that is nearer than its neighbours.
void search_interval(const SpaceSpline& spline, std::size_t span, const SpacePoint& p, Nearest& nearest) {
  const int pieces = spline.degree == 1 ? 1 : 4 * spline.degree;
  const double low = spline.knots[span], high = spline.knots[span + 1];
  const auto parameter = [&](int i) {
    return i <= 0 ? low : i >= pieces ? high : low + (high - low) * i / pieces;
  };
  std::vector<double> distances;
  for (int i = 0; i <= pieces; ++i) distances.push_back(distance_at(spline, parameter(i), p));
  for (int i = 0; i <= pieces; ++i) {
    if ((i > 0 && distances[i - 1] < distances[i]) || (i < pieces && distances[i + 1] < distances[i]))
      continue;
    nearest.take(spline, parameter(i), p);
    nearest.take(spline, refined(spline, parameter(i - 1), parameter(i + 1), p), p);
  }
}

}  // namespace

SpacePoint cross(const SpacePoint& a, const SpacePoint& b) {
  return {{a.at[1] * b.at[2] - a.at[2] * b.at[1], a.at[2] * b.at[0] - a.at[0] * b.at[2],
           a.at[0] * b.at[1] - a.at[1] * b.at[0]}};
}

SpacePoint SpaceArc::point_at(double t) const { return centre + std::cos(t) * major + std::sin(t) * minor; }

double SpaceArc::parameter_of(const SpacePoint& p) const {
  const SpacePoint from_centre = p - centre;
  return std::atan2(dot(from_centre, minor) / dot(minor, minor), dot(from_centre, major) / dot(major, major));
}

SpacePoint SpaceSpline::point_at(double t) const {
  if (t == begin() && knots[1] == t) return poles.front();  // without rounding
  if (t == end() && knots[poles.size() + degree - 1] == t) return poles.back();
  const std::size_t span = span_of(*this, t), p = degree;
  std::array<Pole, 16> work;
  for (std::size_t j = 0; j <= p; ++j) work[j] = pole_of(*this, span - p + j);
  for (std::size_t round = 1; round <= p; ++round) {
    for (std::size_t j = p; j >= round; --j) {
      const double low = knots[span - p + j], high = knots[span + 1 + j - round];
      work[j] = blend(work[j - 1], work[j], (t - low) / (high - low));
    }
  }
  return point_of_pole(*this, work[p]);
}

SpaceSpline polyline(std::vector<SpacePoint> points) {
  SpaceSpline spline;
  spline.knots.push_back(0);
  for (std::size_t i = 0; i < points.size(); ++i) spline.knots.push_back(static_cast<double>(i));
  spline.knots.push_back(spline.knots.back());
  spline.poles = std::move(points);
  return spline;
}

std::string fault_of(const SpaceSpline& spline) {
  for (const std::size_t axis : {0, 2}) {
    BSpline plane{spline.degree, spline.knots, {}, spline.weights};
    for (const SpacePoint& p : spline.poles) plane.poles.push_back({p.at[axis], p.at[1]});
    if (std::string fault = fault_of(plane); !fault.empty()) return fault;
  }
  for (std::size_t i = spline.degree + 1; i + spline.degree < spline.poles.size(); ++i) {
    if (spline.knots[i] == spline.knots[i + spline.degree] && spline.begin() < spline.knots[i] &&
        spline.knots[i] < spline.end())
      return "an inner knot has a multiplicity above the degree, so the curve is interrupted there";
  }
  return {};
}

SpaceSpline part_of(SpaceSpline spline, double from, double to) {
  from = at_knot(spline, from), to = at_knot(spline, to);
  raise_multiplicity(spline, from);
  raise_multiplicity(spline, to);
  const std::size_t degree = spline.degree;
  const std::size_t first = std::ranges::upper_bound(spline.knots, from) - spline.knots.begin() - 1;
  const std::size_t last = std::ranges::lower_bound(spline.knots, to) - spline.knots.begin();
  SpaceSpline part;
  part.degree = spline.degree;
  part.poles.assign(spline.poles.begin() + first - degree, spline.poles.begin() + last);
  if (!spline.weights.empty())
    part.weights.assign(spline.weights.begin() + first - degree, spline.weights.begin() + last);
  part.knots.assign(degree + 1, from);
  part.knots.insert(part.knots.end(), spline.knots.begin() + first + 1, spline.knots.begin() + last);
  part.knots.insert(part.knots.end(), degree + 1, to);
  return part;
}

double nearest_parameter(const SpaceSpline& spline, const SpacePoint& p) {
  std::vector<std::pair<double, std::size_t>> intervals;  // with the nearest box at the front
  for (std::size_t span = spline.degree; span < spline.poles.size(); ++span) {
    if (spline.knots[span] < spline.knots[span + 1])
      intervals.emplace_back(distance_of_box(spline, span, p), span);
  }
  std::ranges::make_heap(intervals, std::greater<>());
  Nearest nearest{spline.begin(), std::numeric_limits<double>::infinity()};
  while (!intervals.empty() && intervals.front().first < nearest.distance) {
    search_interval(spline, intervals.front().second, p, nearest);
    std::ranges::pop_heap(intervals, std::greater<>());
    intervals.pop_back();
  }
  return nearest.parameter;
}

std::vector<SpacePoint> sample_of(const SpaceCurve& curve) {
  if (const auto* spline = std::get_if<SpaceSpline>(&curve.shape)) return spline->poles;
  constexpr int intervals = 4;
  const auto& arc = std::get<SpaceArc>(curve.shape);
  std::vector<SpacePoint> points;
  for (int i = 0; i <= intervals; ++i)
    points.push_back(arc.point_at(arc.begin + (arc.end - arc.begin) * i / intervals));
  return points;
}

}  // namespace quadloop::io
