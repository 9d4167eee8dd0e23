#pragma once

#include "mesher/cut/cut_leaf.hpp"
#include "mesher/cut/triangulate.hpp"
#include "mesher/forest/lattice.hpp"

namespace quadloop {

using LocalQuad = std::array<std::int32_t, 4>;

/// The cells of one leaf; numbers are places in its list of nodes.
struct LeafCells {
  std::vector<LocalTriangle> triangles;
  std::vector<LocalQuad> quads;
};

/// Makes the cells of cut leaves: four nodes in good shape stay a quadrilateral, anything else is
/// triangulated.
class LeafCellMaker {
 public:
  /// Replaces `cells`. False where double precision leaves no room for cells of positive area.
  bool make(const Quadrant& q, const Box& box, const CutLeaf& leaf, LeafCells& cells);
  /// The sine of the smallest angle of the triangles made last.
  double smallest_sine() const { return smallest_sine_; }

 private:
  void set_ranks(const Quadrant& q, const Box& box, const CutLeaf& leaf);

  bool triangulate(std::span<const std::span<const std::int32_t>> loops, LeafCells& cells);

  Triangulator triangulator_;
  double smallest_sine_ = 1;
  std::vector<Point> points_;
  std::vector<TieRank> ranks_;
};

/// The closed templates for an uncut leaf (thesis 3.6.2). Nodes are named as CutLeaf::Node::place: 0 to 3
/// corners, 4 to 7 hanging nodes. `finer` has bit s set where side s has a hanging node: none, one, or two on
/// adjacent sides.
std::span<const LocalTriangle> hanging_template(unsigned finer);

}  // namespace quadloop
