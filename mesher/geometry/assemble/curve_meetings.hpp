#pragma once

#include <vector>

#include "mesher/geometry/curve.hpp"

namespace quadloop {

/// Parameters on two segments where they meet, and the point there.
struct CurveMeeting {
  double on_first = 0, on_second = 0;
  Point point;
};

/// Parameters this near to an end count as the end.
constexpr double nearest_to_end = 0x1p-36;

/// Where two segments cross, or where an end of one lies on the other, up to a distance `near`. None if they
/// touch over a length. Two meetings are farther apart than `near`. The segments are halved as long as the
/// boxes of their control points overlap.
std::vector<CurveMeeting> meetings_of(const CurvedSegment& first, const CurvedSegment& second, double near);

}  // namespace quadloop
