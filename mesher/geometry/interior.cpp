#include "mesher/geometry/interior.hpp"

namespace quadloop {

bool Interior::contains(Point p) const {
  const Geometry& g = outline_->geometry();
  if (!segments_) segments_.emplace(g);
  int winding = 0;
  const auto count = [&](std::int32_t s) {
    const bool up = outline_->beyond_y(g.next(s), p.y);
    if (up == outline_->beyond_y(s, p.y)) return;
    if (outline_->has_left(s, p) != up) winding += up ? -1 : 1;  // the ray meets it to the left of p
  };
  segments_->for_each_meeting({{g.box().low.x, p.y}, p}, count);
  return winding > 0;
}

}  // namespace quadloop
