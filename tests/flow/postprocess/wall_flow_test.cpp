// The flow at walls of solutions at nodes and in cells: values, friction, the same on any number of ranks.
#include "flow/postprocess/wall_flow.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "flow/postprocess/boundary_forces.hpp"
#include "flow/postprocess/wall_table.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "tests/flow/postprocess/dense_stream.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow {
namespace {

using test::dense_stream;
using test::world;
using Names = std::vector<std::string>;

Mesh spread(const Mesh& whole) { return scatter_mesh(world(), whole, test::shuffled_order(whole, 5)); }

/// A grid of quads and triangles on the unit square, south and east side "wall".
Mesh grid(BoundaryCondition condition = "wall") {
  Mesh whole = test::Grid{8}.mesh();
  whole.boundaries[0].condition = condition;
  return spread(whole);
}

std::vector<double> row_at(Point at) { return {1 + at.x, 3 * at.y, 5 * at.x, 1 + 2 * at.x - at.y}; }
const Names names{"rho", "U_x", "U_y", "p"};

Field at_nodes(const Mesh& mesh) {
  Field flow{names, {}, {}};
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    const std::vector<double> row = row_at(mesh.points[i]);
    flow.values.insert(flow.values.end(), row.begin(), row.end());
  }
  return flow;
}

/// Values of the cells are those at their centroids.
Field in_cells(const Mesh& mesh) {
  Field flow;
  flow.cells.names = names;
  for (const CellShape& shape : cell_shapes(mesh)) {
    const std::vector<double> row = row_at(shape.centroid);
    flow.cells.values.insert(flow.cells.values.end(), row.begin(), row.end());
  }
  return flow;
}

/// Calls `look(row, place)` at the owned nodes inside the south wall.
void on_the_south(const Mesh& mesh, const Field& flow,
                  const std::function<void(std::span<const double>, Point)>& look) {
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    const Point at = mesh.points[i];
    if (at.y == 0 && at.x > 0.1 && at.x < 0.9) look(flow.row(NodeId{i}), at);
  }
}

TEST(WallFlow, WallsAreKnownByTheirConditions) {
  Mesh mesh;
  for (const auto& [word, condition] : BoundaryCondition::words)
    mesh.boundaries.push_back({std::string("a_") + word, condition, {}});
  EXPECT_EQ(walls_of(mesh), (Names{"a_wall", "a_viscous_wall", "a_inviscid_wall"}));
}

TEST(WallFlow, OfNodesIsTheirsAndItsFrictionTheSlope) {
  const Mesh mesh = grid();
  const Field flow = wall_flow(world(), mesh, at_nodes(mesh), dense_stream(0.1), {"wall"}, "it");
  EXPECT_EQ(flow.names, (Names{"x_velocity", "y_velocity", "pressure", "density", "wall_shear"}));
  ASSERT_EQ(flow.values.size(), flow.width() * mesh.owned_nodes);
  on_the_south(mesh, flow, [](std::span<const double> row, Point at) {
    EXPECT_EQ(row[2], 1 + 2 * at.x);
    EXPECT_EQ(row[3], 1 + at.x);
    EXPECT_NEAR(row[4], 0.1 * 3, 1e-14) << at.x;
  });
  for (const double viscosity : {0.0, 0.1}) {
    const Mesh smooth = grid(viscosity > 0 ? BoundaryCondition::inviscid_wall : BoundaryCondition::wall);
    const Field slips = wall_flow(world(), smooth, at_nodes(smooth), dense_stream(viscosity), {"wall"}, "it");
    EXPECT_EQ(slips.width(), viscosity > 0 ? 5U : 4U);
    on_the_south(smooth, slips, [&](std::span<const double> row, Point) {
      EXPECT_EQ(row.back(), viscosity > 0 ? 0 : row[3]) << "the density, or no friction";
    });
  }
}

TEST(WallFlow, ASolversOwnFrictionCounts) {
  const Mesh mesh = grid();
  for (const bool su2 : {false, true}) {
    Field flow = at_nodes(mesh);
    const Names more =
        su2 ? Names{"Skin_Friction_Coefficient_x", "Skin_Friction_Coefficient_y"} : Names{"wall_shear"};
    Field with{flow.names, {}, {}};
    with.names.insert(with.names.end(), more.begin(), more.end());
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
      const auto row = flow.row(NodeId{i});
      with.values.insert(with.values.end(), row.begin(), row.end());
      for (std::size_t k = 0; k < more.size(); ++k)
        with.values.push_back(0.25 - 7.0 * static_cast<double>(k));
    }
    const Field found = wall_flow(world(), mesh, with, dense_stream(0.1), {"wall"}, "it");
    on_the_south(mesh, found, [&](std::span<const double> row, Point) {
      EXPECT_EQ(row[4], su2 ? 0.25 * dense_stream(0).dynamic_pressure() : 0.25);
    });
  }
}

TEST(WallFlow, OfCellsIsLinearAlongTheWall) {
  const Mesh mesh = spread(test::Grid{8, {1, 1}, true}.mesh());
  Field cells = in_cells(mesh);
  for (std::size_t i = 0; i < cells.cells.values.size(); i += 4) {
    // linear along the wall alone, whatever the height of the centroid: quads and triangles differ in it
    cells.cells.values[i + 3] = 7;
  }
  const Field flow = wall_flow(world(), mesh, cells, dense_stream(0.1), {"wall"}, "it");
  EXPECT_EQ(flow.names, (Names{"x_velocity", "y_velocity", "pressure", "density", "wall_shear"}));
  on_the_south(mesh, flow, [](std::span<const double> row, Point) {
    EXPECT_EQ(row[0], 0) << "no slip";
    EXPECT_NEAR(row[2], 7, 1e-14);
    EXPECT_NEAR(row[4], 0.1 * 3, 1e-13);
  });
  const Field slips = wall_flow(world(), mesh, in_cells(mesh), dense_stream(0), {"wall"}, "it");
  EXPECT_EQ(slips.names, (Names{"x_velocity", "y_velocity", "pressure", "density"}));
  on_the_south(mesh, slips, [](std::span<const double> row, Point) { EXPECT_GT(row[0], 0) << "slips"; });
}

/// Quads alone, three wide and one high: edges of lengths 1, 2 and 4 along the south.
TEST(WallFlow, OfCellsGoesByTheLengthsOfTheEdges) {
  Mesh whole;
  whole.points = {{0, 0}, {1, 0}, {3, 0}, {7, 0}, {0, 1}, {1, 1}, {3, 1}, {7, 1}};
  whole.owned_nodes = 8;
  const auto node = [](int i) { return NodeId{i}; };
  for (const int i : {0, 1, 2}) whole.quads.push_back({node(i), node(i + 1), node(i + 5), node(i + 4)});
  whole.boundaries = {{"south", "wall", {}}, {"rest", "farfield", {}}};
  for (const int i : {0, 1, 2}) {
    whole.boundaries[0].edges.push_back({node(i), node(i + 1)});
    whole.boundaries[1].edges.push_back({node(i + 5), node(i + 4)});
  }
  whole.boundaries[1].edges.push_back({node(3), node(7)});
  whole.boundaries[1].edges.push_back({node(4), node(0)});
  const Mesh mesh = scatter_mesh(world(), whole, own_order(whole));
  const Field flow = wall_flow(world(), mesh, in_cells(mesh), dense_stream(0), {"south"}, "it");
  int on_wall = 0;
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    const Point at = mesh.points[i];
    if (at.y > 0) continue;
    const double x = at.x == 0 ? 0.5 : at.x == 7 ? 5 : at.x;  // at the ends the cell's own
    EXPECT_NEAR(flow.row(NodeId{i})[2], 1 + 2 * x - 0.5, 1e-14) << at.x;
    ++on_wall;
  }
  EXPECT_EQ(world().sum(on_wall), 4);
}

TEST(WallFlow, HasTheSameBitsHoweverTheMeshIsSpread) {
  const test::Grid shape{9};
  Mesh whole = shape.mesh();
  test::jitter(shape, 0.2, 3, whole);
  for (const bool cells : {false, true}) {
    std::vector<std::string> tables;
    std::vector<double> drags;
    for (const MeshOrder& order : {space_filling_order(whole), test::shuffled_order(whole, 8)}) {
      const Mesh mesh = scatter_mesh(world(), whole, order);
      const Field flow = wall_flow(world(), mesh, cells ? in_cells(mesh) : at_nodes(mesh), dense_stream(0.1),
                                   {"wall"}, "it");
      tables.push_back(wall_table(world(), mesh, flow, dense_stream(0.1), {"wall"}));
      drags.push_back(boundary_forces(world(), mesh, flow, dense_stream(0.1), {"wall"}).at(0).cd);
    }
    EXPECT_EQ(tables[0], tables[1]) << cells;
    EXPECT_EQ(drags[0], drags[1]) << cells;
  }
}

/// Two triangles that touch in one node, at which four edges of the wall meet.
TEST(WallFlow, OfCellsHasOneOrderWhereWallsTouch) {
  Mesh whole;
  whole.points = {{0.1, 0.2}, {0.7, -0.1}, {0.9, 0.6}, {-0.3, 0.8}, {-1.1, 0.1}};
  whole.owned_nodes = 5;
  const auto node = [](int i) { return NodeId{i}; };
  whole.triangles = {{node(0), node(1), node(2)}, {node(0), node(3), node(4)}};
  whole.boundaries = {{"wall", "wall", {}}};
  for (const auto& triangle : whole.triangles) {
    for (const std::size_t k : {0, 1, 2})
      whole.boundaries[0].edges.push_back({triangle[k], triangle[(k + 1) % 3]});
  }
  std::vector<std::vector<double>> rows;  // of the first node
  for (int turn = 0; turn < 6; ++turn) {
    const Mesh mesh = scatter_mesh(world(), whole, own_order(whole));
    const Field flow = wall_flow(world(), mesh, in_cells(mesh), dense_stream(0), {"wall"}, "it");
    std::vector<double> own;
    if (mesh.first_node == 0 && mesh.owned_nodes > 0)
      own.assign(flow.values.begin(), flow.values.begin() + 4);
    rows.push_back(world().all_gather_values(std::span<const double>(own)));
    std::ranges::rotate(whole.boundaries[0].edges, whole.boundaries[0].edges.begin() + 1);
  }
  EXPECT_EQ(rows, std::vector<std::vector<double>>(6, rows[0]));
}

TEST(WallFlow, WantsVelocityAndPressure) {
  const Mesh mesh = grid();
  Field flow = in_cells(mesh);
  flow.cells.names[3] = "T";
  EXPECT_THROW(wall_flow(world(), mesh, flow, dense_stream(0), {"wall"}, "it"), InputError);
}

}  // namespace
}  // namespace quadloop::flow
