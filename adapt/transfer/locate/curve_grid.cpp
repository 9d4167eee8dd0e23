#include "adapt/transfer/locate/curve_grid.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "mesher/base/morton.hpp"
#include "mesher/mesh/box_over_ranks.hpp"

namespace quadloop::adapt {

namespace {

constexpr int all_bits = 32;

/// Rounds down, which keeps the order of the coordinates.
std::uint32_t step_at(double offset, double scale) {
  const double step = offset * scale;
  if (!(step > 0)) return 0;
  return step >= 0x1p32 ? std::numeric_limits<std::uint32_t>::max() : static_cast<std::uint32_t>(step);
}

}  // namespace

CurveGrid::CurveGrid(const Communicator& comm, std::span<const Point> points) {
  const Box box = box_over_ranks(comm, points);
  const double side = std::max(box.width(), box.height());
  low_ = box.low;
  scale_ = side > 0 ? std::min(0x1p32 / side, std::numeric_limits<double>::max()) : 0;
}

CurveGrid::Corner CurveGrid::corner_of(Point p) const {
  return {step_at(p.x - low_.x, scale_), step_at(p.y - low_.y, scale_)};
}

std::uint64_t CurveGrid::key_at(Corner corner) { return morton_key(corner.x, corner.y); }

CurveGrid::Square CurveGrid::square_around(const Steps& steps) {
  const auto bits =
      static_cast<int>(std::bit_width((steps.low.x ^ steps.high.x) | (steps.low.y ^ steps.high.y)));
  const auto start = [bits](std::uint32_t step) { return bits == all_bits ? 0U : step >> bits << bits; };
  return {{start(steps.low.x), start(steps.low.y)}, bits};
}

CurveGrid::Corner CurveGrid::Square::last() const {
  const auto more = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
  return {begin.x + more, begin.y + more};
}

CurveGrid::Square CurveGrid::Square::child(int k) const {
  const std::uint32_t half = 1U << (bits - 1);
  return {{begin.x + (k % 2 == 0 ? 0U : half), begin.y + (k / 2 == 0 ? 0U : half)}, bits - 1};
}

bool CurveGrid::Square::meets(const Steps& steps) const {
  const Corner end = last();
  return begin.x <= steps.high.x && steps.low.x <= end.x && begin.y <= steps.high.y && steps.low.y <= end.y;
}

bool CurveGrid::Square::lies_in(const Steps& steps) const {
  const Corner end = last();
  return steps.low.x <= begin.x && end.x <= steps.high.x && steps.low.y <= begin.y && end.y <= steps.high.y;
}

}  // namespace quadloop::adapt
