#pragma once

#include <vector>

#include "adapt/metric/algebra/tensor.hpp"
#include "mesher/mesh/mesh.hpp"
#include "smoother/objective/condition_number.hpp"

namespace quadloop {

/// The cells of a mesh as the tree made them: what targets are made from, so that cells of which nothing is
/// asked are what they should be.
class ShapesOfTree {
 public:
  explicit ShapesOfTree(const Mesh& mesh);

  /// The target matrix of each of this rank's cells, triangles, then quads: its edges as they were, made
  /// shorter along each axis of the metric by as much as the cell is larger than the metric asks for along
  /// it, but at most `stretch` times. `metrics` are at the owned nodes and copies of `now`, the same mesh
  /// with its nodes where they have got to; a cell has the mean of the logarithms at its nodes (Knupp, Eng.
  /// Comput. 28, 2012: targets from a metric). Not collective.
  std::vector<CellTarget> targets(const Mesh& now, const std::vector<LogMetric>& metrics,
                                  double stretch) const;

  /// How many times larger than asked for each of this rank's cells is, along the axis along which the metric
  /// asks for the smallest sizes. Not collective.
  std::vector<double> thinning(const Mesh& now, const std::vector<LogMetric>& metrics) const;

 private:
  struct Shape {
    Point w1, w2;     ///< edges at the first node; of a quad those of the parallelogram nearest to it
    double size = 0;  ///< the edge of a square of the cell's area, or of twice that of a triangle
  };
  std::vector<Shape> shapes_;
};

}  // namespace quadloop
