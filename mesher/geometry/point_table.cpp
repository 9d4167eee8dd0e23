#include "mesher/geometry/point_table.hpp"

#include <bit>

#include "mesher/base/mixed_bits.hpp"

namespace quadloop {

namespace {

/// 0 and -0 are equal, so their hashes must be equal.
std::uint64_t hash_of(Point p) {
  const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number + 0.0); };
  return mixed_bits(mixed_bits(bits(p.x)) + bits(p.y));
}

}  // namespace

PointTable::PointTable(std::span<const Point> points)
    : points_{points}, slots_(std::bit_ceil(2 * points.size() + 1), -1) {
  for (std::int32_t i = 0; i < std::ssize(points); ++i) {
    std::int32_t& slot = slots_[slot_of(points[i])];
    any_twice_ |= slot >= 0;
    if (slot < 0) slot = i;
  }
}

/// The slot of an equal point, or else an empty one.
std::size_t PointTable::slot_of(Point p) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = hash_of(p) & mask;
  while (slots_[at] >= 0 && !(points_[slots_[at]] == p)) at = (at + 1) & mask;
  return at;
}

std::vector<std::int32_t> find_equal_points(std::span<const Point> known, std::span<const Point> points) {
  const PointTable table(known);
  std::vector<std::int32_t> found;
  found.reserve(points.size());
  for (const Point p : points) found.push_back(table.find(p));
  return found;
}

}  // namespace quadloop
