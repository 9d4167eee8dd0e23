#include "mesher/mesh/cells/cells_round_nodes.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

/// Sums over the cells around a node; positions are relative to the node, values to that of the first cell.
struct Sums {
  double cells = 0, first = 0, value = 0;
  Point place;
  double xx = 0, xy = 0, yy = 0;  ///< second moments about the mean position
  Point slope;                    ///< position times value, both relative to their means
};

Point mean_place(const Sums& sums) { return (1 / sums.cells) * sums.place; }

/// `from_node`: vector from the node to the cell's centroid.
void add_cell(double value, Point from_node, Sums& sum, AroundNode& node) {
  node.smallest = std::min(node.smallest, value);
  node.largest = std::max(node.largest, value);
  if (sum.cells == 0) sum.first = value;
  sum.cells += 1;
  sum.value += value - sum.first;
  sum.place = sum.place + from_node;
}

/// Call after all cells have been added.
void add_slope(double value, Point from_node, Sums& sum) {
  const Point d = from_node - mean_place(sum);
  const double difference = value - sum.first - sum.value / sum.cells;
  sum.xx += d.x * d.x;
  sum.xy += d.x * d.y;
  sum.yy += d.y * d.y;
  sum.slope = sum.slope + difference * d;
}

/// If the centroids are closer to a line than this, relative to their extent along it, there is no gradient.
constexpr double flat = 1e-12;

void solve(const Sums& sums, AroundNode& node) {
  const double determinant = sums.xx * sums.yy - sums.xy * sums.xy, trace = sums.xx + sums.yy;
  node.has_gradient = determinant > flat * trace * trace;
  if (!node.has_gradient) return;
  node.gradient = {(sums.yy * sums.slope.x - sums.xy * sums.slope.y) / determinant,
                   (sums.xx * sums.slope.y - sums.xy * sums.slope.x) / determinant};
}

}  // namespace

CellShape shape_of(std::span<const Point> corners) {
  const Point origin = corners[0];
  double twice_area = 0;
  Point moment, mean;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const Point a = corners[k] - origin, b = corners[k + 1] - origin;
    twice_area += cross(a, b);
    moment = moment + cross(a, b) * (a + b);
  }
  for (const Point corner : corners)
    mean = mean + (1.0 / static_cast<double>(corners.size())) * (corner - origin);
  const double area = 0.5 * twice_area;
  const Point from_first = area > 0 ? (1 / (3 * twice_area)) * moment : mean;
  return {area, origin + from_first, from_first};
}

std::vector<CellShape> cell_shapes(const Mesh& mesh) {
  std::vector<CellShape> shapes;
  shapes.reserve(mesh.cell_count());
  const auto append = [&](const auto& cells) {
    for (const auto& nodes : cells) {
      std::array<Point, 4> corners;
      std::ranges::transform(nodes, corners.begin(), [&](NodeId node) { return mesh.point(node); });
      shapes.push_back(shape_of(std::span(corners).first(nodes.size())));
    }
  };
  append(mesh.triangles);
  append(mesh.quads);
  return shapes;
}

CellsRoundNodes::CellsRoundNodes(const Communicator& comm, const Mesh& mesh)
    : comm_{comm},
      mesh_{mesh},
      halo_(comm, mesh),
      shapes_{cell_shapes(mesh)},
      halo_shapes_{halo_.spread(comm, shapes_)} {}

std::vector<AroundNode> CellsRoundNodes::of(const std::vector<double>& of_cells) const {
  QUADLOOP_REQUIRE(of_cells.size() == shapes_.size(), "there must be one value for each cell",
                   of_cells.size(), shapes_.size());
  const std::vector<double> values = halo_.spread(comm_, of_cells);
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<AroundNode> around(halo_.points().size(), {none, -none, {}, false});
  std::vector<Sums> sums(mesh_.owned_nodes);
  const auto visit_all = [&](const auto& visit) {  // in global order, so that sums do not depend on the ranks
    std::size_t cell = 0;
    halo_.for_each_cell([&](const auto& nodes) {
      const Point centroid = halo_shapes_[cell].centroid;
      for (const NodeId node : nodes) {
        if (mesh_.owns(node)) visit(node.value(), values[cell], centroid - mesh_.point(node));
      }
      ++cell;
    });
  };
  visit_all([&](std::int32_t node, double value, Point from_node) {
    add_cell(value, from_node, sums[node], around[node]);
  });
  visit_all(
      [&](std::int32_t node, double value, Point from_node) { add_slope(value, from_node, sums[node]); });
  for (std::int32_t node = 0; node < mesh_.owned_nodes; ++node) {
    if (sums[node].cells > 0) solve(sums[node], around[node]);
  }
  halo_.exchange().update(around);
  around.resize(mesh_.points.size());  // the mesh's own ghosts come before those of the halo
  return around;
}

}  // namespace quadloop
