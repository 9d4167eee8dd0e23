#include "mesher/geometry/assemble/transform.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"

namespace quadloop {

namespace {

Point placed(Point p, const Transform& transform, Point turn) {
  return turned_about(transform.rotate_about, transform.scale * p, turn) + transform.translate;
}

}  // namespace

void apply(const Transform& transform, std::vector<Chain>& chains) {
  const Point turn = unit_vector(transform.rotate_degrees);
  for (Chain& chain : chains) {
    for (Point& p : chain.points) p = placed(p, transform, turn);
    for (Curve& curve : chain.curves) {
      for (Point& p : curve.inner) p = placed(p, transform, turn);
      curve.spacing *= transform.scale;
    }
  }
}

namespace {

/// The bounding box of the chains. Throws InputError if one of them already is a far field.
Box box_without_far_field(const std::vector<Chain>& chains, const std::string& where) {
  for (const Chain& chain : chains) {
    if (chain.name == "farfield") {
      throw InputError(
          fmt::format("{}: the geometry already has a boundary 'farfield' ({}); remove the setting, or "
                      "rename the boundary",
                      where, chain.source));
    }
  }
  return box_of(chains);
}

/// How far the control points of the chains reach from a centre towards a far field; without the rounding of
/// corners that is the larger distance along the axes.
double reach_of(const std::vector<Chain>& chains, FarFieldShape shape, Point centre) {
  double reach = 0;
  const auto include = [&](Point p) {
    const Point arm = p - centre;
    const bool is_round =
        shape == FarFieldShape::circle || (shape == FarFieldShape::rounded_front && arm.x < 0);
    reach = std::max(reach, is_round ? length(arm) : std::max(std::abs(arm.x), std::abs(arm.y)));
  };
  for (const Chain& chain : chains) {
    std::ranges::for_each(chain.points, include);
    for (const Curve& curve : chain.curves) std::ranges::for_each(curve.inner, include);
  }
  return reach;
}

/// The boundary of a square box, counter-clockwise, some of its corners replaced by quarters of a circle.
Chain rounded_square(FarFieldShape shape, const Box& box, const std::string& where) {
  const auto& [low, high] = box;
  const Point centre = box.centre();
  Chain chain{"farfield", false, {{centre.x, low.y}}, where};
  const auto add_corner = [&](Point corner, Point to, bool is_round) {
    if (is_round) return append_segment(chain, {{corner}, {1, std::numbers::sqrt2 / 2, 1}}, to);
    append_line(chain, corner);
    append_line(chain, to);
  };
  const bool all = shape == FarFieldShape::circle;
  add_corner({high.x, low.y}, {high.x, centre.y}, all);
  add_corner(high, {centre.x, high.y}, all);
  add_corner({low.x, high.y}, {low.x, centre.y}, true);
  add_corner(low, chain.points.front(), true);
  chain.points.pop_back();  // the last curve ends at the first point
  return chain;
}

}  // namespace

Box far_field_box(const std::vector<Chain>& chains, FarFieldShape shape, double radius,
                  const std::string& where) {
  const Box box = box_without_far_field(chains, where);
  const Point reach{radius, radius};
  if (shape == FarFieldShape::rectangle) return {box.low - reach, box.high + reach};
  return {box.centre() - reach, box.centre() + reach};
}

void add_far_field(std::vector<Chain>& chains, FarFieldShape shape, const Box& box,
                   const std::string& where) {
  const Box inner = box_without_far_field(chains, where);
  const auto& [low, high] = box;
  const double radius = 0.5 * box.width();
  const bool is_rectangle = shape == FarFieldShape::rectangle;
  const bool is_round = shape == FarFieldShape::circle || shape == FarFieldShape::rounded_front;
  const double reach = is_rectangle ? 0 : reach_of(chains, shape, box.centre());
  const bool encloses = low.x < inner.low.x && low.y < inner.low.y && inner.high.x < high.x &&
                        inner.high.y < high.y && reach < radius;
  if (!encloses) {
    const char* measure = is_round ? "radius" : "half width";
    throw InputError(
        fmt::format("{}: a far field of {} {:g} around ({}, {}) does not enclose the geometry, which "
                    "reaches from ({}, {}) to ({}, {}); make it larger than {}",
                    where, measure, radius, box.centre().x, box.centre().y, inner.low.x, inner.low.y,
                    inner.high.x, inner.high.y, reach));
  }
  if (is_round)
    chains.push_back(rounded_square(shape, box, where));
  else
    chains.push_back({"farfield", false, {low, {high.x, low.y}, high, {low.x, high.y}}, where});
}

}  // namespace quadloop
