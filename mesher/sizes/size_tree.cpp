#include "mesher/sizes/size_tree.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/sizes/quartered_square.hpp"

namespace quadloop {

namespace {

/// The geometry in the roots, row by row.
class RootContents {
 public:
  RootContents(const ShiftedOutline& outline, const TreeGrid& grid) : outline_{outline} {
    for (int tx = 0; tx < grid.trees_x(); ++tx) columns_.push_back(grid.box_of(root_at(tx, 0)));
    for (int ty = 0; ty < grid.trees_y(); ++ty) rows_.push_back(grid.box_of(root_at(0, ty)));
    segments.resize(columns_.size() * rows_.size());
    winding.resize(segments.size());
    for (std::int32_t s = 0; s < outline.geometry().size(); ++s) add(s);
  }

  static Quadrant root_at(int tx, int ty) {
    return {std::int64_t{tx} << Quadrant::unit_level, std::int64_t{ty} << Quadrant::unit_level, 0};
  }

  std::vector<std::vector<std::int32_t>> segments;  ///< that meet the interior, ascending
  std::vector<int> winding;                         ///< around the lower left corner

 private:
  void add(std::int32_t s) {
    const Geometry& g = outline_.geometry();
    const Box box = box_of(g.point(s), g.point(g.next(s)));
    for (std::size_t row = 0; row < rows_.size(); ++row) {
      const double low = rows_[row].low.y, high = rows_[row].high.y;
      if (low > box.high.y) break;
      if (high < box.low.y) continue;
      const bool crosses_low = low >= box.low.y;  // otherwise it is not around the corners
      for (std::size_t column = 0; column < columns_.size(); ++column)
        add(s, box, {{columns_[column].low.x, low}, {columns_[column].high.x, high}}, crosses_low,
            row * columns_.size() + column);
    }
  }
  void add(std::int32_t s, const Box& box, const Box& root, bool crosses_low, std::size_t number) {
    if (crosses_low) winding[number] += outline_.winding_at(s, root.low);
    if (box.meets(root) && outline_.meets(s, root)) segments[number].push_back(s);
  }

  const ShiftedOutline& outline_;
  std::vector<Box> columns_, rows_;
};

}  // namespace

SizeTree::SizeTree(const ShiftedOutline& outline, const TreeGrid& grid, const SizeOptions& options,
                   SizeRules::Unresolved unresolved, const DemandedSplits& demanded)
    : rules_{outline, grid, options, std::move(unresolved), demanded}, corners_{rules_.sized_corners()} {
  // with all segments on each; reserved memory that is not filled costs nothing
  constexpr std::size_t levels = 6;
  segments_.reserve(levels * outline.geometry().points().size());
  RootContents contents(outline, grid);
  Node whole;
  whole.corners_end = size32(corners_);
  for (int ty = 0; ty < grid.trees_y(); ++ty) {
    for (int tx = 0; tx < grid.trees_x(); ++tx) {
      const std::int32_t number = size();
      const auto segments = std::exchange(contents.segments[number], {});
      Node root;
      root.quadrant = RootContents::root_at(tx, ty);
      root.demanded = demanded.root(tx, ty);
      root.segments_begin = size32(segments_);
      segments_.insert(segments_.end(), segments.begin(), segments.end());
      root.segments_end = size32(segments_);
      root.winding = static_cast<std::int16_t>(contents.winding[number]);
      roots_.push_back(number);
      add(root, grid.box_of(root.quadrant), whole);
    }
  }
}

std::int32_t SizeTree::root_of(const Quadrant& q) const {
  const auto tx = q.x >> Quadrant::unit_level, ty = q.y >> Quadrant::unit_level;
  return roots_[ty * grid().trees_x() + tx];
}

void SizeTree::expect_cut_leaves(double leaves) {
  constexpr double nodes_of_leaf = 4;
  nodes_.reserve(nodes_.size() + static_cast<std::size_t>(nodes_of_leaf * leaves));
}

void SizeTree::forget() {
  nodes_.resize(roots_.size());  // the roots are first
  for (Node& root : nodes_) {
    root.children = Node::unknown;
    root.deepest_split = -1;
  }
  segments_.resize(nodes_.back().segments_end);
  corners_.resize(nodes_.back().corners_end);
  nodes_.shrink_to_fit();
  segments_.shrink_to_fit();
}

bool SizeTree::is_split(std::int32_t n) {
  if (node(n).children == Node::unknown) grow(n);
  return node(n).children >= 0;
}

void SizeTree::grow(std::int32_t n) {
  const Node parent = node(n);
  const QuarteredSquare square(rules_.outline(), grid(), parent.quadrant);
  if (!rules_.wants_split(sized(parent, square.box()))) {
    nodes_[n].children = Node::leaf;
    return;
  }
  nodes_[n].children = size();
  std::array<int, 4> winding{};
  passed_.clear();
  for (const std::int32_t s : segments_of(parent)) {
    const QuarteredSquare::Passage passage = square.passage_of(s);
    passed_.push_back(static_cast<std::uint8_t>(passage.quarters));
    for (std::size_t k = 0; k < winding.size(); ++k) winding[k] += passage.winding[k];
  }
  for (const Corner quarter : corners_along_curve) {
    const int k = curve_index(quarter);
    Node child;
    child.quadrant = parent.quadrant.child(quarter);
    child.parent = n;
    child.winding = static_cast<std::int16_t>(parent.winding + winding[k]);
    if (parent.demanded != DemandedSplits::none) child.demanded = demanded().child(parent.demanded, quarter);
    child.segments_begin = size32(segments_);
    for (std::size_t i = 0; i < passed_.size(); ++i) {
      if ((passed_[i] >> k & 1) != 0) segments_.push_back(segments_[parent.segments_begin + i]);
    }
    child.segments_end = size32(segments_);
    add(child, square.box_of(quarter), parent);
  }
  for (std::int32_t above = n; above >= 0 && node(above).deepest_split < parent.quadrant.level;
       above = node(above).parent)
    nodes_[above].deepest_split = parent.quadrant.level;
}

/// Adds the corners of its parent that the node contains; for a root, of all. A corner on a grid line
/// touches the leaves on both sides, so that mirror images agree.
void SizeTree::add(Node node, const Box& box, const Node& parent) {
  node.corners_begin = size32(corners_);
  for (std::int32_t i = parent.corners_begin; i < parent.corners_end; ++i) {
    const std::int32_t vertex = corners_[i];
    if (box.contains(rules_.outline().geometry().point(vertex))) corners_.push_back(vertex);
  }
  node.corners_end = size32(corners_);
  const SizeRules::Judgement said = rules_.judge(sized(node, box));
  node.plain = said.plain;
  node.finest = static_cast<std::int8_t>(said.finest);
  nodes_.push_back(node);
}

SizedQuadrant SizeTree::sized(const Node& node, const Box& box) const {
  return {node.quadrant,
          box,
          segments_of(node),
          part(corners_, node.corners_begin, node.corners_end),
          node.demanded == DemandedSplits::none ? 0 : demanded().finest_level_in(node.demanded),
          node.parent >= 0 && this->node(node.parent).demanded != DemandedSplits::none};
}

}  // namespace quadloop
