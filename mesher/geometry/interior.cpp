#include "mesher/geometry/interior.hpp"

namespace quadloop {

bool Interior::contains(Point p) const {
  const Geometry& g = outline_->geometry();
  int winding = 0;
  segments_.for_each_meeting({{g.box().low.x, p.y}, p},
                             [&](std::int32_t s) { winding += outline_->winding_at(s, p); });
  return winding > 0;
}

}  // namespace quadloop
