#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Closed loops on their way to a Geometry: joined and free of repeated points, but not yet known to be
/// simple, nor turned the right way. Segment s of a loop runs from points[s] to the next point; its boundary
/// is boundary[s].
struct OutlineLoop {
  std::vector<Point> points;
  std::vector<BoundaryId> boundary;
  std::string source;    ///< where its first chain comes from, for messages
  bool directed = true;  ///< whether its chains are
};

struct Outline {
  std::vector<std::string> names;  ///< of the boundaries, as first seen
  std::vector<OutlineLoop> loops;  ///< in the order of their first chains
};

}  // namespace quadloop
