#pragma once

#include <memory>

#include "mesher/geometry/shifted_outline.hpp"

namespace quadloop {

/// Whether a point lies in the domain of a shifted outline, by an exact count of the crossings of a ray to
/// its left; a point on the outline itself is outside. O(log n + k) for a ray that meets k boxes of segments;
/// the index is built at the first question.
class InsideTest {
 public:
  explicit InsideTest(const ShiftedOutline& outline);
  ~InsideTest();
  InsideTest(const InsideTest&) = delete;
  InsideTest& operator=(const InsideTest&) = delete;

  bool contains(Point p) const;

 private:
  struct Index;
  const ShiftedOutline* outline_;
  mutable std::unique_ptr<Index> index_;
};

}  // namespace quadloop
