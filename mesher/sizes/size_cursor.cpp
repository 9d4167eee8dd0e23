#include "mesher/sizes/size_cursor.hpp"

#include <algorithm>
#include <bit>

namespace quadloop {

/// Descends from the last stored node that contains q, but not into a plain node or one that need not be
/// entered.
template <class Enter>
std::int32_t SizeCursor::deepest_node_at(const Quadrant& q, const Enter& enter) {
  const auto differing = static_cast<std::uint64_t>((q.x ^ x_) | (q.y ^ y_));
  int level = std::min({depth_, q.level, Quadrant::unit_level - static_cast<int>(std::bit_width(differing))});
  if (level < 0) {  // in another tree
    level = 0;
    path_[0] = tree_.root_of(q);
  }
  std::int32_t n = path_[level];
  for (; level < q.level && !tree_.node(n).plain && enter(tree_.node(n)) && tree_.is_split(n);
       path_[++level] = n)
    n = tree_.node(n).children + curve_index(quarter_at(q.x, q.y, level));
  x_ = q.x;
  y_ = q.y;
  depth_ = level;
  return n;
}

/// Or its lowest ancestor with geometry.
std::int32_t SizeCursor::deepest_with_geometry(const Quadrant& q) {
  return deepest_node_at(q, [&](const SizeTree::Node& n) { return !tree_.segments_of(n).empty(); });
}

std::span<const std::int32_t> SizeCursor::segments_in(const Quadrant& q) {
  const SizeTree::Node& node = tree_.node(deepest_with_geometry(q));
  const std::span<const std::int32_t> inside = tree_.segments_of(node);
  if (inside.empty() || node.quadrant == q) return inside;
  found_.clear();
  const Box box = tree_.grid().box_of(q);
  for (const std::int32_t s : inside) {
    if (tree_.rules().outline().meets(s, box)) found_.push_back(s);
  }
  return found_;
}

/// Along the bottom from the lower left corner of the node, then up.
bool SizeCursor::is_inside(const Quadrant& q, Corner corner) {
  const SizeTree::Node& node = tree_.node(deepest_with_geometry(q));
  const ShiftedOutline& outline = tree_.rules().outline();
  const GridPoint place = q.at(site_of(corner));
  const TreeGrid& grid = tree_.grid();
  int winding = node.winding;
  for (const std::int32_t s : tree_.segments_of(node)) {
    const Point from = grid.corner(node.quadrant.x, node.quadrant.y), to = grid.corner(place),
                turn{to.x, from.y};
    winding += outline.winding_between(s, from, turn) + outline.winding_between(s, turn, to);
  }
  return winding > 0;
}

int SizeCursor::target_level(const Quadrant& leaf) {
  const auto always = [](const SizeTree::Node&) { return true; };
  return std::min(leaf.level,
                  std::max(tree_.node(deepest_node_at(leaf, always)).quadrant.level, tree_.coarsest_level()));
}

}  // namespace quadloop
