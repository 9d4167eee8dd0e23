#include "io/step/step_plane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"

namespace quadloop::io {

namespace {

/// A point of a curve.
struct Place {
  SpacePoint p;
  const StepCurve* curve = nullptr;

  std::string text() const {
    return fmt::format("{} has the point ({:.9g}, {:.9g}, {:.9g})", curve->entity.title(), p.at[0], p.at[1],
                       p.at[2]);
  }
};

/// The smallest and the largest coordinate of all curves.
struct Range {
  Place low, high;

  double width(int axis) const { return high.p.at[axis] - low.p.at[axis]; }
};

std::array<Range, 3> ranges_of(std::span<const StepCurve> curves) {
  std::array<Range, 3> ranges;
  for (const StepCurve& curve : curves) {
    for (const SpacePoint& p : sample_of(curve.curve)) {
      for (int axis = 0; axis < 3; ++axis) {
        Range& range = ranges[axis];
        if (range.low.curve == nullptr || p.at[axis] < range.low.p.at[axis]) range.low = {p, &curve};
        if (range.high.curve == nullptr || p.at[axis] > range.high.p.at[axis]) range.high = {p, &curve};
      }
    }
  }
  return ranges;
}

Chain chain_of(const StepPlane& plane, const SpaceSpline& spline, Point first) {
  Chain chain;
  chain.points = {first};
  if (spline.degree == 1) {
    for (std::size_t i = 1; i < spline.poles.size(); ++i) append_line(chain, plane.project(spline.poles[i]));
    return chain;
  }
  BSpline flat{spline.degree, spline.knots, {}, spline.weights};
  for (const SpacePoint& pole : spline.poles) flat.poles.push_back(plane.project(pole));
  append_bspline(chain, flat);
  return chain;
}

Chain chain_of(const StepPlane& plane, const SpaceArc& arc, Point first) {
  Chain chain;
  chain.points = {first};
  append_arc(chain, {plane.project(arc.centre), plane.project(arc.major), plane.project(arc.minor), arc.begin,
                     arc.end});
  return chain;
}

/// Divides each segment of an open chain at its middle.
Chain divided(const Chain& chain) {
  Chain result;
  result.points = {chain.points.front()};
  for (std::size_t i = 0; i + 1 < chain.points.size(); ++i) {
    const Curve curve = chain.curves.empty() ? Curve() : chain.curves[i];
    auto [left, right] = halves({chain.points[i], curve, chain.points[i + 1]});
    append_segment(result, std::move(left.curve), left.to);
    append_segment(result, std::move(right.curve), right.to);
  }
  return result;
}

}  // namespace

std::string StepPlane::name() const {
  constexpr std::string_view axes = "XYZ";
  return {axes[first], axes[second]};
}

StepPlane plane_of(std::span<const StepCurve> curves) {
  constexpr double flat = 1e-6;
  constexpr std::array<std::array<int, 3>, 3> planes{
      {{0, 1, 2}, {0, 2, 1}, {1, 2, 0}}};  // the last axis is normal
  const std::array<Range, 3> ranges = ranges_of(curves);
  const double extent = std::max({ranges[0].width(0), ranges[1].width(1), ranges[2].width(2)});
  for (const auto& [first, second, normal] : planes) {
    if (ranges[normal].width(normal) <= flat * extent) return {first, second, extent};
  }
  int thinnest = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (ranges[axis].width(axis) < ranges[thinnest].width(thinnest)) thinnest = axis;
  }
  const auto& [low, high] = ranges[thinnest];
  throw InputError(
      fmt::format("{}: the curves are not in one plane parallel to the XY, XZ or YZ plane: {}, and {}; place "
                  "the sketch or face in "
                  "one of these planes, and export it alone",
                  low.curve->entity.place(), low.text(), high.text()));
}

Chain chain_in(const StepPlane& plane, const SpaceCurve& curve) {
  const Point first = plane.project(curve.first), last = plane.project(curve.last);
  Chain chain = std::visit([&](const auto& shape) { return chain_of(plane, shape, first); }, curve.shape);
  chain.points.back() = last;
  if (first == last) {
    while (chain.points.size() < 4) chain = divided(chain);
    chain.points.pop_back();
  }
  chain.open = first != last;
  chain.directed = false;
  return chain;
}

}  // namespace quadloop::io
