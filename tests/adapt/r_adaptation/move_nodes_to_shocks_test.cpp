// Nodes gathered at a front by target matrices: less error on the same cells, valid ones; far from the front,
// on the front of layers and where nothing bends nothing moves; the same mesh on any number of ranks.
#include "adapt/r_adaptation/move_nodes_to_shocks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adapt/metric/node_bends.hpp"
#include "adapt/r_adaptation/transferred_norm.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

/// A square of edge 2 whose floor may have layers.
MeshInput square(MeshType type, double size, bool layers = false) {
  Boundary floor{"floor", 0, 30, "wall"}, side{"side", 0, 30, "wall"};
  if (layers) floor.layers = LayerSpec{0.01, 1.2, 1.2, 3};
  MeshInput input{{{floor, side},
                   {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
                   {0, 4},
                   {BoundaryId{0}, BoundaryId{1}, BoundaryId{1}, BoundaryId{1}}},
                  {},
                  {},
                  0};
  input.mesh.type = type;
  input.mesh.size.min = input.mesh.size.max = size;
  return input;
}

double front(Point p) { return std::tanh(20 * (p.x + 0.3 * p.y - 0.1)); }

template <class Function>
Field field_on(const Mesh& mesh, const Function& function) {
  Field field{{"q"}, {}, {}};
  for (std::int32_t n = 0; n < mesh.owned_nodes; ++n) field.values.push_back(function(mesh.point(NodeId{n})));
  return field;
}

/// About the L1 norm of the error of interpolation, of a whole mesh.
double error_of(const Mesh& whole) {
  double sum = 0;
  const auto add = [&](Point a, Point b, Point c) {
    double error = 0;
    for (const auto& [p, q] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
      error += std::abs(front(0.5 * (p + q)) - 0.5 * (front(p) + front(q))) / 3;
    sum += 0.5 * cross(b - a, c - a) * error;
  };
  for (const auto& t : whole.triangles) add(whole.point(t[0]), whole.point(t[1]), whole.point(t[2]));
  for (const auto& q : whole.quads) {
    add(whole.point(q[0]), whole.point(q[1]), whole.point(q[2]));
    add(whole.point(q[0]), whole.point(q[2]), whole.point(q[3]));
  }
  return sum;
}

TargetDemand demand(double norm) { return {{"q"}, norm, 1.0 / 64, 8}; }

struct Gathered {
  Mesh before;  ///< the same cells
  MeshResult result;
};

/// The solution is known on the mesh as the tree makes it.
template <class Function>
Gathered gathered(const Communicator& comm, const MeshInput& input, const Function& solution,
                  double norm = 2) {
  const Mesh solved = generate_mesh(comm, input).result.mesh;
  Gathered made;
  const MeshChange change = [&](const MeshInput& outer, MeshResult& result) {
    made.before = result.mesh;
    move_nodes_to_shocks(comm, outer, solved, field_on(solved, solution), demand(norm), result);
  };
  made.result = generate_mesh(comm, input, {}, {}, change).result;
  return made;
}

TEST(MoveNodesToShocks, BringsTheErrorDownOnTheSameValidCells) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    const Gathered made = gathered(world(), square(type, 0.125), front);
    const Mesh before = gather_whole(world(), made.before), after = gather_whole(world(), made.result.mesh);
    if (!world().is_root()) continue;
    EXPECT_EQ(after.triangles, before.triangles);
    EXPECT_EQ(after.quads, before.quads);
    EXPECT_LT(error_of(after), 0.5 * error_of(before));
    const auto faults = validate(after);
    EXPECT_TRUE(faults.empty()) << faults.front().what;
  }
}

TEST(MoveNodesToShocks, LeavesCellsFarFromTheFront) {
  const auto at_the_left = [](Point p) { return std::tanh(40 * (p.x + 0.3 * p.y + 0.7)); };
  const Gathered made = gathered(world(), square(MeshType::hybrid, 0.0625), at_the_left);
  std::int64_t moved = 0;
  for (std::size_t n = 0; n < made.before.points.size(); ++n) {
    const Point p = made.before.points[n];
    moved += made.result.mesh.points[n] != p ? 1 : 0;
    if (p.x + 0.3 * p.y + 0.7 > 0.9) {
      EXPECT_EQ(made.result.mesh.points[n], p);
    }
  }
  EXPECT_GT(world().sum(moved), 100);
}

/// Bends everywhere, in all directions.
double ragged(Point p) { return std::sin(1e4 * p.x + 3e3 * p.y * p.y) + std::cos(7e3 * p.x * p.y); }

/// By what the solved mesh, of the same input, knows of second derivatives.
double norm_of(const Mesh& mesh, const MeshInput& input, double (*solution)(Point), double p) {
  const Mesh solved = generate_mesh(world(), input).result.mesh;
  const Field rows = rows_of(variable_bends(world(), solved, field_on(solved, solution)), solved.owned_nodes);
  return norm_by_bends(world(), mesh, transferred<Symmetric>(world(), solved, rows, mesh), p);
}

TEST(MoveNodesToShocks, NeverRaisesTheNorm) {
  for (const auto solution : {front, ragged}) {
    for (const double p : {1.0, 3.0, 100.0}) {
      const MeshInput input = square(MeshType::hybrid, 0.125);
      const Gathered made = gathered(world(), input, solution, p);
      const double before = norm_of(made.before, input, solution, p),
                   after = norm_of(made.result.mesh, input, solution, p);
      EXPECT_LE(after, before) << "p = " << p;
      const bool stays = made.result.mesh.points == made.before.points;
      EXPECT_EQ(world().any(!stays), made.result.report.warnings.empty());
    }
  }
}

TEST(MoveNodesToShocks, IsTheSameOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  const Gathered all = gathered(world(), square(MeshType::hybrid, 0.125), front),
                 here = gathered(self, square(MeshType::hybrid, 0.125), front);
  const Mesh whole = gather_whole(world(), all.result.mesh), alone = gather_whole(self, here.result.mesh);
  if (!world().is_root()) return;
  EXPECT_EQ(whole.points, alone.points);
  EXPECT_EQ(whole.quads, alone.quads);
}

/// How many nodes of the floor, or of the front of its layers, have moved along it.
std::int64_t moved_on_floor(const MeshInput& input) {
  const Mesh solved = generate_mesh(world(), input).result.mesh;
  std::int64_t moved = 0;
  const MeshChange change = [&](const MeshInput& outer, MeshResult& result) {
    const std::vector<Point> before = result.mesh.points;
    move_nodes_to_shocks(world(), outer, solved, field_on(solved, front), demand(2), result);
    for (const auto& edge : result.mesh.boundaries[0].edges)
      moved += result.mesh.point(edge[0]) != before[edge[0].value()] ? 1 : 0;
  };
  generate_mesh(world(), input, {}, {}, change);
  return world().sum(moved);
}

TEST(MoveNodesToShocks, SlidesNodesOfWallsAndKeepsTheFrontOfLayers) {
  EXPECT_GT(moved_on_floor(square(MeshType::hybrid, 0.125)), 4);
  EXPECT_EQ(moved_on_floor(square(MeshType::hybrid, 0.125, true)), 0);
}

TEST(MoveNodesToShocks, SaysThatNothingBends) {
  const Gathered made =
      gathered(world(), square(MeshType::hybrid, 0.25), [](Point p) { return 2 * p.x - p.y; });
  EXPECT_EQ(made.result.mesh.points, made.before.points);
  ASSERT_EQ(made.result.report.warnings.size(), 1U);
  EXPECT_NE(made.result.report.warnings.front().find("no node is moved"), std::string::npos);
}

}  // namespace
}  // namespace quadloop::adapt
