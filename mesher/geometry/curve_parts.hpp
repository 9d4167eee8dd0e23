#pragma once

#include <utility>

#include "mesher/geometry/curve.hpp"

namespace quadloop {

/// The parts of a curve before and after the point above a point of its chord, above_chord(). Both request
/// the spacing of the whole.
std::pair<CurvedSegment, CurvedSegment> parts_at(const CurvedSegment& segment, Point p);

/// Same for a parameter from 0 to 1.
std::pair<CurvedSegment, CurvedSegment> parts_at_parameter(const CurvedSegment& segment, double t);

}  // namespace quadloop
