#pragma once

#include <cstdint>
#include <span>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::adapt {

/// A grid of 2^32 by 2^32 steps over a box, numbered along a Morton curve. Rounding to steps keeps the order
/// of coordinates; a point outside the box is mapped to the nearest one on its border.
class CurveGrid {
 public:
  struct Corner {
    std::uint32_t x = 0, y = 0;
  };
  /// The steps that a box meets, the last ones included.
  struct Steps {
    Corner low, high;
  };
  /// A square of 2^bits steps, aligned to a multiple of its size, and so a contiguous range of the curve.
  struct Square {
    Corner begin;
    int bits = 0;

    Corner last() const;
    Square child(int k) const;
    bool meets(const Steps& steps) const;
    bool lies_in(const Steps& steps) const;
  };

  CurveGrid() = default;
  /// Over the bounding box of all ranks' points. *Collective.*
  CurveGrid(const Communicator& comm, std::span<const Point> points);

  std::uint64_t key_of(Point p) const { return key_at(corner_of(p)); }
  Steps steps_of(const Box& box) const { return {corner_of(box.low), corner_of(box.high)}; }

  static std::uint64_t key_at(Corner corner);
  /// The smallest square that contains these steps. Their keys lie between the keys of its two corners.
  static Square square_around(const Steps& steps);

 private:
  Corner corner_of(Point p) const;

  Point low_;
  double scale_ = 0;  ///< steps per unit of length
};

}  // namespace quadloop::adapt
