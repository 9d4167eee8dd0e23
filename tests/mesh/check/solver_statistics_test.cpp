// Figures against those of the whole mesh, worked out another way, on any number of ranks.
#include "mesher/mesh/check/solver_statistics.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "mesher/mesh/check/edge_statistics.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::Grid;
using test::world;

/// Calls `visit(nodes)` for each cell of a whole mesh.
template <class Visit>
void for_each_cell(const Mesh& mesh, const Visit& visit) {
  for (const auto& nodes : mesh.triangles) visit(std::vector<NodeId>(nodes.begin(), nodes.end()));
  for (const auto& nodes : mesh.quads) visit(std::vector<NodeId>(nodes.begin(), nodes.end()));
}

double area_of_polygon(const std::vector<Point>& polygon) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    twice += cross(polygon[k], polygon[(k + 1) % polygon.size()]);
  return twice / 2;
}

/// The nodes off the boundary at which the flux of (x, 0) or (0, x), (y, 0), (0, y) out of the dual cell,
/// taken at the middles of edges, is not the divergence times its area: edge by edge.
std::int64_t count_inexact(const Mesh& mesh) {
  std::map<std::pair<NodeId, NodeId>, Point> faces;  // of each ordered pair of nodes: out of the first
  std::map<NodeId, double> areas;
  for_each_cell(mesh, [&](const std::vector<NodeId>& nodes) {
    Point centre;
    for (const NodeId n : nodes) centre = centre + (1.0 / static_cast<double>(nodes.size())) * mesh.point(n);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const NodeId a = nodes[k], b = nodes[(k + 1) % nodes.size()],
                   before = nodes[(k + nodes.size() - 1) % nodes.size()];
      const Point to_centre = centre - 0.5 * (mesh.point(a) + mesh.point(b)), face{to_centre.y, -to_centre.x};
      faces[{a, b}] = faces[{a, b}] + face;
      faces[{b, a}] = faces[{b, a}] - face;
      areas[a] += area_of_polygon({mesh.point(a), 0.5 * (mesh.point(a) + mesh.point(b)), centre,
                                   0.5 * (mesh.point(a) + mesh.point(before))});
    }
  });
  std::map<NodeId, std::array<double, 4>> divergence;
  for (const auto& [nodes, face] : faces) {
    const Point middle = 0.5 * (mesh.point(nodes.first) + mesh.point(nodes.second));
    auto& sums = divergence[nodes.first];
    const std::array<double, 4> flux{middle.x * face.x, middle.x * face.y, middle.y * face.x,
                                     middle.y * face.y};
    for (std::size_t k = 0; k < 4; ++k) sums[k] += flux[k];
  }
  std::set<NodeId> rim;
  for (const BoundaryEdges& b : mesh.boundaries) {
    for (const auto& edge : b.edges) rim.insert(edge.begin(), edge.end());
  }
  std::int64_t count = 0;
  for (const auto& [node, sums] : divergence) {
    const double area = areas[node];
    double error = 0;
    for (std::size_t k = 0; k < 4; ++k)
      error = std::max(error, std::abs(sums[k] - (k == 0 || k == 3 ? area : 0)));
    count += !rim.contains(node) && error > 0.002 * area ? 1 : 0;
  }
  return count;
}

std::int64_t count_parallelograms(const Mesh& mesh) {
  std::int64_t count = 0;
  for (const auto& q : mesh.quads)
    count +=
        skew_of({mesh.point(q[0]), mesh.point(q[1]), mesh.point(q[2]), mesh.point(q[3])}) <= 0.01 ? 1 : 0;
  return count;
}

void expect_statistics_of_whole(const Mesh& whole) {
  const std::int64_t inexact = count_inexact(whole), parallel = count_parallelograms(whole);
  const double ratio = area_ratios(Communicator(MPI_COMM_SELF), whole).largest;
  for (const MeshOrder& order : {space_filling_order(whole), test::shuffled_order(whole, 5)}) {
    const SolverStatistics statistics = solver_statistics(world(), scatter_mesh(world(), whole, order));
    EXPECT_EQ(statistics.inexact_nodes, inexact);
    EXPECT_EQ(statistics.parallelograms, parallel);
    EXPECT_EQ(statistics.quads, std::ssize(whole.quads));
    EXPECT_EQ(statistics.area_ratio_max, ratio);
  }
}

TEST(SolverStatistics, OfSquaresAndTriangles) {
  const Mesh mesh = Grid{8}.mesh();
  EXPECT_GT(count_inexact(mesh), 0);  // at single squares among triangles
  EXPECT_LT(count_inexact(mesh), 49);
  expect_statistics_of_whole(mesh);
}

TEST(SolverStatistics, OfSkewQuads) {
  const Grid grid{10, {3, 1}};
  Mesh mesh = grid.mesh();
  test::jitter(grid, 0.2, 3, mesh);
  EXPECT_LT(count_parallelograms(mesh), 5);
  expect_statistics_of_whole(mesh);
}

TEST(SolverStatistics, OfTrianglesAlone) {
  Grid grid{10};
  grid.quads = false;
  Mesh mesh = grid.mesh();
  test::jitter(grid, 0.24, 8, mesh);
  EXPECT_EQ(count_inexact(mesh), 0);
  expect_statistics_of_whole(mesh);
}

TEST(SolverStatistics, OfOneSmallCellAmongLargeOnes) {
  const Grid grid{9};
  Mesh mesh = grid.mesh();
  mesh.points[44] = mesh.points[44] + Point{0.08, 0.08};
  expect_statistics_of_whole(mesh);
}

TEST(SolverStatistics, CountPassages) {
  Mesh mesh;  // three squares in a row, and a triangle at either end: the squares reach from wall to wall,
              // two of their sides on it apart
  mesh.points = {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {0, 1}, {1, 1}, {2, 1}, {3, 1}, {-1, 0.5}, {4, 0.5}};
  mesh.owned_nodes = 10;
  const auto quad = [](std::int32_t i) {
    return std::array{NodeId{i}, NodeId{i + 1}, NodeId{i + 5}, NodeId{i + 4}};
  };
  mesh.quads = {quad(0), quad(1), quad(2)};
  mesh.triangles = {{NodeId{8}, NodeId{0}, NodeId{4}}, {NodeId{3}, NodeId{9}, NodeId{7}}};
  mesh.boundaries = {{"wall", "wall", {}}};
  const std::array<std::int32_t, 10> around{8, 0, 1, 2, 3, 9, 7, 6, 5, 4};
  for (std::size_t k = 0; k < around.size(); ++k) {
    mesh.boundaries[0].edges.push_back({NodeId{around[k]}, NodeId{around[(k + 1) % around.size()]}});
  }
  for (const MeshOrder& order : {space_filling_order(mesh), test::shuffled_order(mesh, 2)}) {
    EXPECT_EQ(solver_statistics(world(), scatter_mesh(world(), mesh, order)).passage_cells, 3);
  }
}

}  // namespace
}  // namespace quadloop
