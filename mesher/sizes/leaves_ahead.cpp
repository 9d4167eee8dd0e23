#include "mesher/sizes/leaves_ahead.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace quadloop {

namespace {

/// Returns the number of leaves in a square of this size at a distance from leaves of size h, where sizes
/// grow with the slope away from them.
double graded_leaves(double size, double gap, double h, double slope) {
  const double near = h + slope * gap, far = near + slope * size;
  return size / slope * (1 / near - 1 / far);
}

/// Returns the fraction of the square covered by the source's bounding box; 0 for a line.
double covered_share(const SizeSource& source, const Box& square) {
  if (std::holds_alternative<SizeSource::Line>(source.shape)) return 0;
  const Box box = box_of(source);
  const double width = std::min(box.high.x, square.high.x) - std::max(box.low.x, square.low.x);
  const double height = std::min(box.high.y, square.high.y) - std::max(box.low.y, square.low.y);
  return std::max(0.0, width) * std::max(0.0, height) / (square.width() * square.height());
}

}  // namespace

double LeavesAhead::below(const Quadrant& q) {
  const SizeRules& rules = tree_.rules();
  const double slope = std::ldexp(static_cast<double>(rules.slope()), -SizeRules::slope_bits),
               size = static_cast<double>(q.size());
  double lines = 0;
  for (const std::int32_t n : gradation_.split_near(q)) {
    const double h = std::ldexp(1.0, Quadrant::unit_level - level_ahead(n));
    const auto gap = static_cast<double>(chebyshev_gap(q, tree_.node(n).quadrant));
    lines = std::max(lines, graded_leaves(size, gap, h, slope));
  }
  const int coarsest = rules.coarsest_level();
  const double whole =
      q.level < coarsest && rules.in_domains_box(q) ? std::ldexp(1.0, 2 * (coarsest - q.level)) : 0;
  return 1 + lines + whole + source_leaves(q);
}

double LeavesAhead::source_leaves(const Quadrant& q) const {
  const SizeRules& rules = tree_.rules();
  const Box box = rules.grid().box_of(q);
  double leaves = 0;
  for (const SizeSource& source : rules.sources()) {
    const int deeper = rules.level_for(source.spacing) - q.level;
    if (deeper > 0 && meets(source, box)) leaves += covered_share(source, box) * std::ldexp(1.0, 2 * deeper);
  }
  return leaves;
}

/// Returns the expected level of the finest leaves in a split node.
int LeavesAhead::level_ahead(std::int32_t node) {
  const std::size_t index = node;
  if (levels_.size() <= index) levels_.resize(tree_.size(), 0);
  if (levels_[index] != 0) return levels_[index];
  const SizeRules& rules = tree_.rules();
  const SizeTree::Node& n = tree_.node(node);
  int level = std::max(n.quadrant.level + 1, rules.level_of_outline(n.quadrant, tree_.segments_of(n)));
  if (n.demanded != DemandedSplits::none) level = std::max(level, rules.demanded().finest_level());
  const Box box = rules.grid().box_of(n.quadrant);
  for (const SizeSource& source : rules.sources()) {
    if (level < rules.level_for(source.spacing) && meets(source, box))
      level = rules.level_for(source.spacing);
  }
  levels_[index] = static_cast<std::int8_t>(level);
  return level;
}

}  // namespace quadloop
