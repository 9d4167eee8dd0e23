#include "mesher/geometry/assemble/transform.hpp"

#include <fmt/format.h>

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

}  // namespace

Box far_field_box(const std::vector<Chain>& chains, double half_width, const std::string& where) {
  const Point centre = box_without_far_field(chains, where).centre();
  return {centre - Point{half_width, half_width}, centre + Point{half_width, half_width}};
}

void add_far_field(std::vector<Chain>& chains, const Box& square, const std::string& where) {
  const Box box = box_without_far_field(chains, where);
  const auto& [low, high] = square;
  if (!(low.x < box.low.x && low.y < box.low.y && box.high.x < high.x && box.high.y < high.y)) {
    throw InputError(
        fmt::format("{}: a far field of half width {:g} around ({}, {}) does not enclose the geometry, which "
                    "reaches from ({}, {}) to "
                    "({}, {}); make it larger than {}",
                    where, 0.5 * square.width(), square.centre().x, square.centre().y, box.low.x, box.low.y,
                    box.high.x, box.high.y, 0.5 * std::max(box.width(), box.height())));
  }
  chains.push_back({"farfield", false, {low, {high.x, low.y}, high, {low.x, high.y}}, where});
}

}  // namespace quadloop
