#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A coordinate as mantissa * 2^exponent with an odd mantissa; zero is 0 * 2^0.
struct Binary {
  std::int64_t mantissa = 0;
  int exponent = 0;
};

inline Binary binary(double coordinate) {
  if (coordinate == 0) return {};
  constexpr int digits = 52, bias = 1075;
  constexpr std::uint64_t hidden = std::uint64_t{1} << digits;
  const auto bits = std::bit_cast<std::uint64_t>(coordinate);
  const auto field = static_cast<int>(bits >> digits) & 0x7ff;
  const std::uint64_t digits_set = (bits & (hidden - 1)) | (field == 0 ? 0 : hidden);
  const int zeros = std::countr_zero(digits_set);
  const auto mantissa = static_cast<std::int64_t>(digits_set >> zeros);
  return {std::signbit(coordinate) ? -mantissa : mantissa, std::max(field, 1) - bias + zeros};
}

/// Points in units of the largest power of two that divides all their coordinates.
class IntegerPoints {
 public:
  explicit IntegerPoints(const std::array<Point, 4>& points) {
    int lowest = std::numeric_limits<int>::max();
    for (std::size_t i = 0; i < points.size(); ++i) {
      coordinates_[2 * i] = binary(points[i].x);
      coordinates_[2 * i + 1] = binary(points[i].y);
    }
    for (const Binary& b : coordinates_) {
      if (b.mantissa != 0) lowest = std::min(lowest, b.exponent);
    }
    exponent_ = lowest;
    for (Binary& b : coordinates_) {
      if (b.mantissa == 0) continue;
      b.exponent -= lowest;
      const auto magnitude = static_cast<std::uint64_t>(std::abs(b.mantissa));
      bits_ = std::max(bits_, static_cast<int>(std::bit_width(magnitude)) + b.exponent);
    }
  }

  /// Number of bits of the largest coordinate.
  int bits() const { return bits_; }
  /// The unit is 2 to this power.
  int exponent() const { return exponent_; }
  template <class Integer>
  Integer x(std::size_t i) const {
    return coordinate<Integer>(2 * i);
  }
  template <class Integer>
  Integer y(std::size_t i) const {
    return coordinate<Integer>(2 * i + 1);
  }
  template <class Integer>
  Integer dx(std::size_t i, std::size_t from) const {
    return coordinate<Integer>(2 * i) - coordinate<Integer>(2 * from);
  }
  template <class Integer>
  Integer dy(std::size_t i, std::size_t from) const {
    return coordinate<Integer>(2 * i + 1) - coordinate<Integer>(2 * from + 1);
  }

 private:
  template <class Integer>
  Integer coordinate(std::size_t i) const {
    return Integer(coordinates_[i].mantissa) *
           (Integer(1) << static_cast<unsigned>(coordinates_[i].exponent));
  }
  std::array<Binary, 8> coordinates_;
  int bits_ = 0, exponent_ = 0;
};

}  // namespace quadloop
