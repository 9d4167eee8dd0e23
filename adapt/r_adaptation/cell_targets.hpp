#pragma once

#include <vector>

#include "adapt/metric/algebra/tensor.hpp"
#include "mesher/mesh/mesh.hpp"
#include "smoother/objective/condition_number.hpp"

namespace quadloop::adapt {

/// The original shapes of a mesh's cells, on which targets are based, so that cells without requirements are
/// at their target.
class ShapesOfTree {
 public:
  explicit ShapesOfTree(const Mesh& mesh);

  /// The target matrix of each local cell, triangles, then quadrilaterals: its original edges, shortened
  /// along each axis of the metric by the ratio of the cell size to the requested size, at most by `stretch`.
  /// `metrics` are at the owned nodes and ghost copies of `now`, the same mesh with its present node
  /// positions; a cell uses the mean of the logarithms at its nodes (Knupp, Eng. Comput. 28, 2012: targets
  /// from a metric). Not collective.
  std::vector<smoother::CellTarget> targets(const Mesh& now, const std::vector<LogMetric>& metrics,
                                            double stretch) const;

  /// For each local cell the ratio of its size to the requested size along the axis with the smallest
  /// requested size. Not collective.
  std::vector<double> thinning(const Mesh& now, const std::vector<LogMetric>& metrics) const;

 private:
  struct Shape {
    Point w1, w2;     ///< edges at the first node; for a quadrilateral those of the nearest parallelogram
    double size = 0;  ///< edge of a square with the cell's area, or with twice the area of a triangle
  };
  std::vector<Shape> shapes_;
};

}  // namespace quadloop::adapt
