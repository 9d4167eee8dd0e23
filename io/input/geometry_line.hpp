#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop::io {

/// A line of a geometry: a closed polygon, in either direction, or an open line.
struct GeometryLine {
  std::string boundary;
  std::vector<Point> points;
  bool open = false;
};

}  // namespace quadloop::io
