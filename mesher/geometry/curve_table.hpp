#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/shared_array.hpp"
#include "mesher/geometry/curve.hpp"

namespace quadloop {

class NodeMemory;

/// The curves of numbered segments in three arrays, whose memory ranks can share.
class CurveTable {
 public:
  CurveTable() = default;  ///< all segments are straight
  explicit CurveTable(std::span<const Curve> curves);

  /// Whether it has a row for each segment; otherwise all are straight.
  bool empty() const { return rows_.empty(); }
  bool straight(std::int32_t segment) const { return inner_of(segment).empty(); }
  double spacing(std::int32_t segment) const { return rows_[segment].spacing; }
  Curve operator[](std::int32_t segment) const;

  /// Returns the table of the first rank. *Collective.*
  CurveTable once_per_node(const NodeMemory& memory) const;

 private:
  struct Row {
    std::int32_t inner = 0, weights = 0;  ///< where those of the segment begin; they end with the next row's
    double spacing = 0;
    std::int64_t interpolates = 0;
  };
  std::span<const Point> inner_of(std::int32_t segment) const {
    return std::span(inner_.begin() + rows_[segment].inner, inner_.begin() + rows_[segment + 1].inner);
  }

  SharedArray<Row> rows_;  ///< and one after the last
  SharedArray<Point> inner_;
  SharedArray<double> weights_;
};

}  // namespace quadloop
