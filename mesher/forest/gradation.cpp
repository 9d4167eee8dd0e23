// The part of SizeTree that keeps the gradation: which quadrants are too large for a leaf of the wanted tree
// near them.
#include <algorithm>

#include "mesher/forest/size_tree.hpp"

namespace quadloop {

namespace {

constexpr int slope_bits = 20;

/// Whether a leaf of size `small` at this gap forbids a leaf of size `large`.
bool forbids(std::int64_t small, std::int64_t gap, std::int64_t large, std::int64_t slope) {
  return ((large - small) << slope_bits) > gap * slope;
}

/// The edge of the leaves of a level.
std::int64_t leaf_size(int level) { return std::int64_t{1} << (Quadrant::unit_level - level); }

}  // namespace

bool SizeTree::must_split(const Quadrant& q) {
  if (q.level >= finest_) return false;
  if (q.level < coarsest_) {
    const bool near_domain = forbids(leaf_size(coarsest_), gap_to_domain(q), q.size(),
                                     slope_);  // whose leaves are as small as that at least
    if (near_domain || in_domains_box(q)) return true;
  }
  return forced(q, step_above(q).near);
}

/// The path's last step becomes the parent of q, with its list of near nodes. A step depends on its place
/// alone, so those that still hold q stay.
SizeTree::Step& SizeTree::step_above(const Quadrant& q) {
  const auto depth = static_cast<std::size_t>(q.level);  // steps at levels 0 .. depth-1
  if (path_.size() < depth) path_.resize(depth);
  std::size_t kept = depth;
  while (kept > 0 && !(path_[kept - 1].has_near && path_[kept - 1].place.contains(q))) --kept;
  for (std::size_t level = kept; level < depth; ++level) {
    Step& step = path_[level];
    const std::int64_t mask = ~((std::int64_t{1} << (Quadrant::unit_level - static_cast<int>(level))) - 1);
    step.place = {q.x & mask, q.y & mask, static_cast<int>(level)};
    fill_near(step, level == 0 ? roots_ : path_[level - 1].near);
  }
  return path_[depth - 1];
}

/// `parents` are the nodes of this step's size whose children may matter to it.
void SizeTree::fill_near(Step& step, const std::vector<std::int32_t>& parents) {
  step.near.clear();
  step.has_near = true;
  const std::int64_t half = step.place.size() / 2;
  for (const std::int32_t parent : parents) {
    const Node& whole = nodes_[static_cast<std::size_t>(parent)];
    if (!forbids(leaf_size(whole.finest), chebyshev_gap(step.place, whole.place), half, slope_) ||
        !is_split(parent))
      continue;
    const std::int32_t first = nodes_[static_cast<std::size_t>(parent)].children;
    for (std::int32_t child = first; child < first + 4; ++child) {
      const Node& node = nodes_[static_cast<std::size_t>(child)];
      if (node.plain) continue;  // its leaves are as large as any in the domain may be
      if (forbids(leaf_size(node.finest), chebyshev_gap(step.place, node.place), half, slope_) &&
          is_split(child))
        step.near.push_back(child);
    }
  }
}

bool SizeTree::forced(const Quadrant& q, const std::vector<std::int32_t>& near) {
  // First what needs no search: a node split at level l holds a leaf of size size(l)/2 or smaller somewhere
  // within it.
  for (const std::int32_t n : near) {
    const Node& node = nodes_[static_cast<std::size_t>(n)];
    const std::int64_t small = std::int64_t{1} << (Quadrant::unit_level - node.deepest_split - 1);
    const std::int64_t farthest = chebyshev_gap(q, node.place) + node.place.size() - small;
    if (node.place == q || forbids(small, farthest, q.size(), slope_)) return true;
  }
  return std::any_of(near.begin(), near.end(), [&](std::int32_t n) { return forced_by(q, n); });
}

/// Whether some leaf of the wanted tree in this node forbids a leaf q.
bool SizeTree::forced_by(const Quadrant& q, std::int32_t node) {
  const Node& within = nodes_[static_cast<std::size_t>(node)];
  if (within.plain) return false;
  const Quadrant place = within.place;
  const std::int64_t gap = chebyshev_gap(q, place);
  if (!forbids(leaf_size(within.finest), gap, q.size(), slope_)) return false;
  if (!is_split(node)) return forbids(place.size(), gap, q.size(), slope_);
  const std::int32_t first = nodes_[static_cast<std::size_t>(node)].children;
  for (std::int32_t child = first; child < first + 4; ++child) {
    if (forced_by(q, child)) return true;
  }
  return false;
}

}  // namespace quadloop
