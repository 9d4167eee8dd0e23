#include "adapt/r_adaptation/cell_targets.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/mesh/cells/cells_round_nodes.hpp"

namespace quadloop::adapt {

ShapesOfTree::ShapesOfTree(const Mesh& mesh) {
  const std::vector<CellShape> cells = cell_shapes(mesh);
  const auto edge = [&](NodeId from, NodeId to) { return mesh.point(to) - mesh.point(from); };
  for (const auto& t : mesh.triangles) {
    const double size = std::sqrt(2 * cells[shapes_.size()].area);
    shapes_.push_back({edge(t[0], t[1]), edge(t[0], t[2]), size});
  }
  for (const auto& q : mesh.quads) {
    const double size = std::sqrt(cells[shapes_.size()].area);
    shapes_.push_back(
        {0.5 * (edge(q[0], q[1]) + edge(q[3], q[2])), 0.5 * (edge(q[0], q[3]) + edge(q[1], q[2])), size});
  }
}

namespace {

/// The metric requested by the nodes of a cell: mean of the logarithms.
template <class Nodes>
Eigen2 asked_in(const Nodes& nodes, const std::vector<LogMetric>& metrics) {
  Symmetric sum;
  for (const NodeId node : nodes) sum = sum + metrics[node.value()];
  return eigen_of((1.0 / static_cast<double>(nodes.size())) * sum);
}

}  // namespace

std::vector<double> ShapesOfTree::thinning(const Mesh& now, const std::vector<LogMetric>& metrics) const {
  std::vector<double> thinning;
  thinning.reserve(shapes_.size());
  const auto add = [&](const auto& nodes) {
    const double size = shapes_[thinning.size()].size;
    thinning.push_back(size * std::exp(0.5 * asked_in(nodes, metrics).larger));
  };
  std::ranges::for_each(now.triangles, add);
  std::ranges::for_each(now.quads, add);
  return thinning;
}

std::vector<smoother::CellTarget> ShapesOfTree::targets(const Mesh& now,
                                                        const std::vector<LogMetric>& metrics,
                                                        double stretch) const {
  std::vector<smoother::CellTarget> targets;
  targets.reserve(shapes_.size());
  const auto add = [&](const auto& nodes) {
    const Shape& shape = shapes_[targets.size()];
    const auto kept = [&](double logarithm) {  // remaining fraction of the cell's extent along an axis
      return 1 / std::clamp(shape.size * std::exp(0.5 * logarithm), 1.0, stretch);
    };
    const Eigen2 mean = asked_in(nodes, metrics);
    const Symmetric shorter = symmetric_of({kept(mean.larger), kept(mean.smaller), mean.axis});
    const auto mapped = [&](Point p) {
      return Point{shorter.xx * p.x + shorter.xy * p.y, shorter.xy * p.x + shorter.yy * p.y};
    };
    targets.push_back({mapped(shape.w1), mapped(shape.w2)});
  };
  std::ranges::for_each(now.triangles, add);
  std::ranges::for_each(now.quads, add);
  return targets;
}

}  // namespace quadloop::adapt
