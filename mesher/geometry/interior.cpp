#include "mesher/geometry/interior.hpp"

#include <algorithm>
#include <vector>

#include "mesher/base/error.hpp"

namespace quadloop {

bool Interior::contains(Point p) const {
  const Geometry& g = outline_->geometry();
  int winding = 0;
  segments_.for_each_meeting({{g.box().low.x, p.y}, p},
                             [&](std::int32_t s) { winding += outline_->winding_at(s, p); });
  return winding > 0;
}

std::int32_t Interior::block_at(Point p) const {
  const Geometry& g = outline_->geometry();
  if (!g.has_blocks()) return 0;
  std::vector<int> winding(g.block_names().size(), 0);
  segments_.for_each_meeting({{g.box().low.x, p.y}, p},
                             [&](std::int32_t s) { winding[g.block_of(s)] += outline_->winding_at(s, p); });
  const auto found = std::ranges::find_if(winding, [](int turns) { return turns > 0; });
  QUADLOOP_REQUIRE(found != winding.end(), "a point of the domain belongs to a block");
  return static_cast<std::int32_t>(found - winding.begin());
}

}  // namespace quadloop
