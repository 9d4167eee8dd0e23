#pragma once

#include "mesher/cut/cut_leaf.hpp"
#include "mesher/cut/triangulate.hpp"
#include "mesher/lattice/lattice.hpp"

namespace quadloop {

using LocalQuad = std::array<std::int32_t, 4>;

/// The cells of one leaf; numbers are indices in its list of nodes.
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
  /// The leaf that cells are being made for.
  struct Leaf {
    const Quadrant* quadrant = nullptr;
    const Box* box = nullptr;
    const CutLeaf* cut = nullptr;
  };
  const TieRank& rank_of(std::int32_t node);
  void set_ranks();

  bool triangulate(std::span<const std::span<const std::int32_t>> loops, LeafCells& cells);

  Triangulator triangulator_;
  Leaf leaf_;
  double smallest_sine_ = 1;
  std::vector<Point> points_;
  std::vector<std::span<const std::int32_t>> loops_;
  std::vector<TieRank> ranks_;  ///< of the leaf's nodes; none before they are asked for
};

/// A triangle of a template: its nodes by where they sit.
using SiteTriangle = std::array<Site, 3>;

/// The closed templates for an uncut leaf with hanging nodes (thesis 3.6.2): on one side, or on two adjacent
/// ones.
std::span<const SiteTriangle> hanging_template(SideSet hanging);

}  // namespace quadloop
