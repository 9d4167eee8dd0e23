#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Closed loops before they become a Geometry: joined and without repeated points, but not yet checked to be
/// simple nor oriented. Segment s of a loop runs from points[s] to the next point and is on boundary[s].
struct OutlineLoop {
  std::vector<Point> points;
  std::vector<BoundaryId> boundary;
  std::string source;              ///< source of its first chain, for messages
  bool directed = true;            ///< whether its chains are
  std::vector<Curve> curves = {};  ///< the shape of each segment; empty: all are straight
  std::vector<char> returns = {};  ///< flags segments against the direction of an inner line; may be empty
};

struct Outline {
  std::vector<std::string> names;  ///< of the boundaries, as first seen
  std::vector<OutlineLoop> loops;  ///< in the order of their first chains
};

}  // namespace quadloop
