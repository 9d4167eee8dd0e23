#include "mesher/sizes/size_tree.hpp"

#include <tuple>
#include <utility>

#include "mesher/base/ids.hpp"

namespace quadloop {

SizeTree::SizeTree(const ShiftedOutline& outline, const Lattice& lattice, const SizeOptions& options,
                   SizeRules::Unresolved unresolved, const DemandedSplits& demanded)
    : rules_{outline, lattice, options, std::move(unresolved), demanded}, corners_{rules_.sized_corners()} {
  Node whole;
  whole.segments_end = outline.geometry().size();
  constexpr std::size_t levels = 6;  // with all segments on each; room that is not filled takes no memory
  segments_.reserve(levels * outline.geometry().size());
  whole.corners_end = size32(corners_);
  for (int ty = 0; ty < lattice.trees_y(); ++ty) {
    for (int tx = 0; tx < lattice.trees_x(); ++tx) {
      Node root;
      root.quadrant = {std::int64_t{tx} << Quadrant::unit_level, std::int64_t{ty} << Quadrant::unit_level, 0};
      root.demanded = demanded.root(tx, ty);
      roots_.push_back(size());
      add(root, whole);
    }
  }
}

std::int32_t SizeTree::root_of(const Quadrant& q) const {
  const auto tx = q.x >> Quadrant::unit_level, ty = q.y >> Quadrant::unit_level;
  return roots_[ty * lattice().trees_x() + tx];
}

bool SizeTree::is_split(std::int32_t n) const {
  if (node(n).children == Node::unknown) grow(n);
  return node(n).children >= 0;
}

void SizeTree::grow(std::int32_t n) const {
  const Node parent = node(n);
  if (!rules_.wants_split(sized(parent))) {
    nodes_[n].children = Node::leaf;
    return;
  }
  nodes_[n].children = size();
  for (const Corner quarter : corners_along_curve) {
    Node child;
    child.quadrant = parent.quadrant.child(quarter);
    child.parent = n;
    if (parent.demanded != DemandedSplits::none) child.demanded = demanded().child(parent.demanded, quarter);
    add(child, parent);
  }
  for (std::int32_t above = n; above >= 0 && node(above).deepest_split < parent.quadrant.level;
       above = node(above).parent)
    nodes_[above].deepest_split = parent.quadrant.level;
}

/// Takes over what the node holds of its parent's segments and corners; a root, of all segments, whose
/// numbers stand in no list. A corner on a lattice line touches the leaves on both its sides, so that mirror
/// images agree.
void SizeTree::add(Node child, const Node& parent) const {
  const Box box = lattice().box_of(child.quadrant);
  const ShiftedOutline& outline = rules_.outline();
  const auto take = [](std::vector<std::int32_t>& all, std::int32_t begin, std::int32_t end, bool listed,
                       const auto& holds) {
    const auto first = size32(all);
    for (std::int32_t i = begin; i < end; ++i) {
      const std::int32_t number = listed ? all[i] : i;
      if (holds(number)) all.push_back(number);
    }
    return std::pair(first, size32(all));
  };
  std::tie(child.segments_begin, child.segments_end) =
      take(segments_, parent.segments_begin, parent.segments_end, child.parent >= 0,
           [&](std::int32_t s) { return outline.meets(s, box); });
  std::tie(child.corners_begin, child.corners_end) =
      take(corners_, parent.corners_begin, parent.corners_end, true,
           [&](std::int32_t v) { return box.contains(outline.geometry().point(v)); });
  const SizeRules::Judgement said = rules_.judge(sized(child));
  child.plain = said.plain;
  child.finest = static_cast<std::int8_t>(said.finest);
  nodes_.push_back(child);
}

SizedQuadrant SizeTree::sized(const Node& node) const {
  return {node.quadrant,
          lattice().box_of(node.quadrant),
          segments_of(node),
          part(corners_, node.corners_begin, node.corners_end),
          node.demanded == DemandedSplits::none ? 0 : demanded().finest_level_in(node.demanded),
          node.parent >= 0 && this->node(node.parent).demanded != DemandedSplits::none};
}

}  // namespace quadloop
