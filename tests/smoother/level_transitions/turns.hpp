#pragma once

#include "mesher/geometry/point.hpp"

namespace quadloop::test {

/// A mesh's places as they are, after a quarter turn and after half a turn.
inline Point upright(Point p) { return p; }
inline Point on_its_side(Point p) { return {-p.y, p.x}; }
inline Point upside_down(Point p) { return {-p.x, -p.y}; }

}  // namespace quadloop::test
