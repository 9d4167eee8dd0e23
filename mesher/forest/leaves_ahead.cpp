// The part of SizeTree that guesses what splitting a quadrant leads to, from what the nodes near it ask for.
#include <algorithm>
#include <cmath>

#include "mesher/forest/size_tree.hpp"

namespace quadloop {

namespace {

constexpr double slope_unit = 0x1p-20, turning_unit = 0x1p-20;

/// Leaves in a square of this size at a gap from leaves of size h, where sizes grow with the slope away from
/// them.
double graded_leaves(double size, double gap, double h, double slope) {
  const double near = h + slope * gap, far = near + slope * size;
  return size / slope * (1 / near - 1 / far);
}

/// The share of the square that the source's box covers.
double covered_share(const Source& source, const Box& square) {
  Box box;
  if (const auto* area = std::get_if<Box>(&source.shape)) {
    box = *area;
  } else if (const auto* disc = std::get_if<Source::Disc>(&source.shape)) {
    box = {disc->centre - Point{disc->radius, disc->radius},
           disc->centre + Point{disc->radius, disc->radius}};
  } else {
    return 0;
  }
  const double width = std::min(box.high.x, square.high.x) - std::max(box.low.x, square.low.x);
  const double height = std::min(box.high.y, square.high.y) - std::max(box.low.y, square.low.y);
  return std::max(0.0, width) * std::max(0.0, height) / (square.width() * square.height());
}

}  // namespace

double SizeTree::leaves_ahead(const Quadrant& q) {
  const double slope = static_cast<double>(slope_) * slope_unit, size = static_cast<double>(q.size());
  double lines = 0;
  for (const std::int32_t n : step_above(q).near) {
    const double h = std::ldexp(1.0, Quadrant::unit_level - level_ahead(n));
    const auto gap = static_cast<double>(chebyshev_gap(q, nodes_[static_cast<std::size_t>(n)].place));
    lines = std::max(lines, graded_leaves(size, gap, h, slope));
  }
  const double whole =
      q.level < coarsest_ && in_domains_box(q) ? std::ldexp(1.0, 2 * (coarsest_ - q.level)) : 0;
  return 1 + lines + whole + source_leaves(q);
}

double SizeTree::source_leaves(const Quadrant& q) const {
  const Box box = lattice_->box_of(q);
  double leaves = 0;
  for (const Source& source : options_.sources) {
    const int deeper = level_for(source.spacing) - q.level;
    if (deeper > 0 && meets(source, box)) leaves += covered_share(source, box) * std::ldexp(1.0, 2 * deeper);
  }
  return leaves;
}

/// The level that the finest leaves in a split node may be expected to have.
int SizeTree::level_ahead(std::int32_t node) {
  const auto index = static_cast<std::size_t>(node);
  if (levels_ahead_.size() <= index) levels_ahead_.resize(nodes_.size(), 0);
  if (levels_ahead_[index] != 0) return levels_ahead_[index];
  const Node& n = nodes_[index];
  int level = std::max(n.place.level + 1, level_of_outline(n));
  if (n.demanded != DemandedSplits::none) level = std::max(level, demanded_->finest_level());
  const Box box = lattice_->box_of(n.place);
  for (const Source& source : options_.sources) {
    if (level < level_for(source.spacing) && meets(source, box)) level = level_for(source.spacing);
  }
  levels_ahead_[index] = static_cast<std::int8_t>(level);
  return level;
}

/// By the segments' spacing, and by curvature as if the outline turned evenly along the node.
int SizeTree::level_of_outline(const Node& node) const {
  double spacing = lattice_->tree_edge();
  std::int64_t turning = 0;
  for (std::int32_t i = node.segments_begin; i < node.segments_end; ++i) {
    const auto s = static_cast<std::size_t>(segments_[static_cast<std::size_t>(i)]);
    spacing = std::min(spacing, spacing_[s]);
    turning += turning_[s];
  }
  if (options_.curvature && turning > 0) {
    const double turns = static_cast<double>(turning) * turning_unit / *options_.curvature;
    spacing = std::min(spacing, lattice_->edge(node.place.level) / turns);
  }
  return level_for(spacing);
}

}  // namespace quadloop
