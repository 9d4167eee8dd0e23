#include "mesher/forest/leaf_finder.hpp"

#include <algorithm>
#include <bit>

namespace quadloop {

LeafId LeafFinder::leaf_at(std::int64_t x, std::int64_t y) {
  if (!graph_.in_root(x, y)) return LeafGraph::none;
  const auto differing = static_cast<std::uint64_t>((x ^ x_) | (y ^ y_));
  int level = std::min(depth_, Quadrant::unit_level - static_cast<int>(std::bit_width(differing)));
  if (level < 0) {  // another tree
    level = 0;
    path_[0] = graph_.root_at(x, y);
  }
  LeafGraph::Ref ref = path_[level];
  for (; LeafGraph::is_inner(ref); path_[++level] = ref) ref = graph_.down(ref, quarter_at(x, y, level));
  x_ = x;
  y_ = y;
  depth_ = level;
  return LeafId{ref};
}

}  // namespace quadloop
