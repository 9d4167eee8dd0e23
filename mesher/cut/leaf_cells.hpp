#pragma once

#include "mesher/cut/cut_leaf.hpp"
#include "mesher/cut/triangulate.hpp"
#include "mesher/grid/tree_grid.hpp"

namespace quadloop {

using LocalQuad = std::array<std::int32_t, 4>;

/// The cells of one leaf; numbers are indices into its nodes.
struct LeafCells {
  std::vector<LocalTriangle> triangles;
  std::vector<LocalQuad> quads;
  std::vector<std::int32_t> triangle_blocks, quad_blocks;
};

/// Creates the cells of cut leaves: four well-placed nodes give a quadrilateral, anything else is
/// triangulated.
class LeafCellMaker {
 public:
  /// Replaces `cells`. Returns false if double precision does not allow cells of positive area.
  bool make(const Quadrant& q, const Box& box, const CutLeaf& leaf, LeafCells& cells);
  /// Sine of the smallest angle of the last triangles.
  double smallest_sine() const { return smallest_sine_; }

 private:
  /// The current leaf.
  struct Leaf {
    const Quadrant* quadrant = nullptr;
    const Box* box = nullptr;
    const CutLeaf* cut = nullptr;
  };
  const TieRank& rank_of(std::int32_t node);
  void set_ranks();

  bool make_block(std::int32_t block, LeafCells& cells);
  bool triangulate(std::span<const std::span<const std::int32_t>> loops, LeafCells& cells);

  Triangulator triangulator_;
  Leaf leaf_;
  double smallest_sine_ = 1;
  std::vector<Point> points_;
  std::vector<std::span<const std::int32_t>> loops_;  ///< of one block
  std::vector<TieRank> ranks_;                        ///< of the leaf's nodes; computed on first use
};

/// A triangle of a template, by the sites of its nodes.
using SiteTriangle = std::array<Site, 3>;

/// Returns the fixed template for an uncut leaf with hanging nodes (thesis 3.6.2): on one side, or on two
/// adjacent ones.
std::span<const SiteTriangle> hanging_template(SideSet hanging);

}  // namespace quadloop
