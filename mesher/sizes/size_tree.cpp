#include "mesher/sizes/size_tree.hpp"

#include <array>
#include <utility>

#include "mesher/base/ids.hpp"
#include "mesher/sizes/quartered_square.hpp"

namespace quadloop {

SizeTree::SizeTree(const ShiftedOutline& outline, const TreeGrid& grid, const SizeOptions& options,
                   SizeRules::Unresolved unresolved, const DemandedSplits& demanded)
    : rules_{outline, grid, options, std::move(unresolved), demanded}, corners_{rules_.sized_corners()} {
  const std::int32_t all = outline.geometry().size();
  // with all segments on each; reserved memory that is not filled costs nothing
  constexpr std::size_t levels = 6;
  segments_.reserve(levels * all);
  Node whole;
  whole.corners_end = size32(corners_);
  for (int ty = 0; ty < grid.trees_y(); ++ty) {
    for (int tx = 0; tx < grid.trees_x(); ++tx) {
      Node root;
      root.quadrant = {std::int64_t{tx} << Quadrant::unit_level, std::int64_t{ty} << Quadrant::unit_level, 0};
      root.demanded = demanded.root(tx, ty);
      const Box box = grid.box_of(root.quadrant);
      root.segments_begin = size32(segments_);
      for (std::int32_t s = 0; s < all; ++s) {
        root.winding = static_cast<std::int16_t>(root.winding + outline.winding_at(s, box.low));
        if (outline.meets(s, box)) segments_.push_back(s);
      }
      root.segments_end = size32(segments_);
      roots_.push_back(size());
      add(root, box, whole);
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
