#pragma once

#include <vector>

#include "mesher/grid/tree_grid.hpp"
#include "mesher/sizes/demanded_splits.hpp"

namespace quadloop {

/// The sizes of cells that follow from the leaves requested by adaptation, as a function of the place. The
/// same on every rank; a mirrored set of leaves has mirrored sizes, bit for bit.
class DemandedSizes {
 public:
  /// `gradation`: the growth limit g of SizeOptions. Grid and splits must outlive the object.
  DemandedSizes(const TreeGrid& grid, const DemandedSplits& demanded, double gradation);

  /// The smallest size h + (g-1)/2 d on the segment between two points, where h is the edge of a requested
  /// leaf and d its distance from the segment; `most` if that is smaller.
  double near(Point a, Point b, double most) const;

 private:
  struct Tree {
    Quadrant quadrant;
    std::int32_t number;  ///< in DemandedSplits
  };

  const TreeGrid& grid_;
  const DemandedSplits& demanded_;
  double growth_;  ///< of the size, per distance
  std::vector<Tree> trees_;
};

}  // namespace quadloop
