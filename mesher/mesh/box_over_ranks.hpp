#pragma once

#include <span>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Returns the bounding box of all ranks' points, on every rank. *Collective.*
inline Box box_over_ranks(const Communicator& comm, std::span<const Point> points) {
  Box box;
  for (const Point p : points) box.include(p);
  return {{comm.minimum(box.low.x), comm.minimum(box.low.y)},
          {comm.maximum(box.high.x), comm.maximum(box.high.y)}};
}

}  // namespace quadloop
