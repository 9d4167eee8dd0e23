#include "mesher/sizes/gradation.hpp"

#include <algorithm>

namespace quadloop {

namespace {

/// Whether a leaf of size `small` at this distance forbids a leaf of size `large`.
bool forbids(std::int64_t small, std::int64_t gap, std::int64_t large, std::int64_t slope) {
  return ((large - small) << SizeRules::slope_bits) > gap * slope;
}

/// Returns the edge of the leaves of a level.
std::int64_t leaf_size(int level) { return std::int64_t{1} << (Quadrant::unit_level - level); }

}  // namespace

bool Gradation::must_split(const Quadrant& q) {
  const SizeRules& rules = tree_.rules();
  if (q.level >= rules.finest_level()) return false;
  if (q.level < rules.coarsest_level()) {  // leaves in the domain are at least this fine
    const bool near_domain =
        forbids(leaf_size(rules.coarsest_level()), rules.gap_to_domain(q), q.size(), rules.slope());
    if (near_domain || rules.in_domains_box(q)) return true;
  }
  return forced(q, split_near(q));
}

const std::vector<std::int32_t>& Gradation::split_near(const Quadrant& q) { return step_above(q).near; }

/// Makes the parent of q the last step of the path, with its list of near nodes. A step depends only on its
/// quadrant, so those that still contain q are kept.
Gradation::Step& Gradation::step_above(const Quadrant& q) {
  const std::size_t depth = q.level;  // steps at levels 0 .. depth-1
  if (path_.size() < depth) path_.resize(depth);
  std::size_t kept = depth;
  while (kept > 0 && !(path_[kept - 1].has_near && path_[kept - 1].quadrant.contains(q))) --kept;
  for (std::size_t level = kept; level < depth; ++level) {
    Step& step = path_[level];
    const std::int64_t mask = ~((std::int64_t{1} << (Quadrant::unit_level - static_cast<int>(level))) - 1);
    step.quadrant = {q.x & mask, q.y & mask, static_cast<int>(level)};
    fill_near(step, level == 0 ? tree_.roots() : path_[level - 1].near);
  }
  return path_[depth - 1];
}

/// `parents` are the nodes of this step's size whose children may affect it.
void Gradation::fill_near(Step& step, const std::vector<std::int32_t>& parents) {
  step.near.clear();
  step.has_near = true;
  const std::int64_t half = step.quadrant.size() / 2;
  for (const std::int32_t parent : parents) {
    const SizeTree::Node& whole = tree_.node(parent);
    if (!forbids(leaf_size(whole.finest), chebyshev_gap(step.quadrant, whole.quadrant), half,
                 tree_.rules().slope()) ||
        !tree_.is_split(parent))
      continue;
    const std::int32_t first = tree_.node(parent).children;
    for (std::int32_t child = first; child < first + 4; ++child) {
      const SizeTree::Node& node = tree_.node(child);
      if (node.plain) continue;  // its leaves are as large as possible in the domain
      if (forbids(leaf_size(node.finest), chebyshev_gap(step.quadrant, node.quadrant), half,
                  tree_.rules().slope()) &&
          tree_.is_split(child))
        step.near.push_back(child);
    }
  }
}

bool Gradation::forced(const Quadrant& q, const std::vector<std::int32_t>& near) {
  // First the test without a search: a node split at level l contains a leaf of size size(l)/2 or smaller.
  for (const std::int32_t n : near) {
    const SizeTree::Node& node = tree_.node(n);
    const std::int64_t small = std::int64_t{1} << (Quadrant::unit_level - node.deepest_split - 1);
    const std::int64_t farthest = chebyshev_gap(q, node.quadrant) + node.quadrant.size() - small;
    if (node.quadrant == q || forbids(small, farthest, q.size(), tree_.rules().slope())) return true;
  }
  return std::any_of(near.begin(), near.end(), [&](std::int32_t n) { return forced_by(q, n); });
}

/// Whether some leaf of the wanted tree in this node forbids a leaf q.
bool Gradation::forced_by(const Quadrant& q, std::int32_t node) {
  const SizeTree::Node& within = tree_.node(node);
  if (within.plain) return false;
  const Quadrant other = within.quadrant;
  const std::int64_t gap = chebyshev_gap(q, other);
  if (!forbids(leaf_size(within.finest), gap, q.size(), tree_.rules().slope())) return false;
  if (!tree_.is_split(node)) return forbids(other.size(), gap, q.size(), tree_.rules().slope());
  const std::int32_t first = tree_.node(node).children;
  for (std::int32_t child = first; child < first + 4; ++child) {
    if (forced_by(q, child)) return true;
  }
  return false;
}

}  // namespace quadloop
