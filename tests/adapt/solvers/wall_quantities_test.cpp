// Forces and the flow at walls of any solver's solution.
#include "adapt/solvers/wall_quantities.hpp"

#include <gtest/gtest.h>

#include "flow/postprocess/wall_table.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

const flow::FreeStream stream{2, 3, 4, 0, 1.5, 0, 0.5};

Mesh spread_grid() {
  Mesh whole = test::Grid{6}.mesh();
  whole.boundaries[0].condition = BoundaryCondition::wall;
  whole.boundaries[1].condition = BoundaryCondition::farfield;
  return scatter_mesh(world(), whole, test::shuffled_order(whole, 3));
}

/// A pressure of 3 + y + 2, in the cells, and what else the solver tells.
flow::FlowSolver cell_solver(std::optional<double> lift) {
  return [lift](const Communicator&, const Mesh& mesh, const Field&, int) {
    flow::SolvedFlow flow;
    flow.solution.cells.names = {"U_x", "U_y", "p"};
    for (const CellShape& shape : cell_shapes(mesh)) {
      for (const double value : {4.0, 0.0, 5 + shape.centroid.y}) flow.solution.cells.values.push_back(value);
    }
    flow.cl = lift;
    if (lift) flow.cd = -1;
    return flow;
  };
}

TEST(WallQuantities, AreMadeOfAFlowInCells) {
  const Mesh mesh = spread_grid();
  const flow::SolvedFlow flow = with_wall_quantities(cell_solver({}), stream)(world(), mesh, {}, 0);
  ASSERT_EQ(flow.forces.size(), 1U);
  EXPECT_EQ(flow.forces[0].boundary, "wall");
  ASSERT_TRUE(flow.stream && flow.cl && flow.cd);
  const double scale = 1 / (stream.dynamic_pressure() * stream.reference_length);
  EXPECT_NEAR(*flow.cd, 2.5 * scale, 1e-2 * scale) << "on the east side 2 + y";
  EXPECT_EQ(*flow.cd, flow.forces[0].cd);
  EXPECT_EQ(*flow.cl, flow.forces[0].cl);
  EXPECT_EQ(flow.solution.names.size(), 0U) << "the solution stays in cells";
  const std::string table = flow::wall_table(world(), mesh, flow.at_walls, stream, {"wall"});
  EXPECT_EQ(table.starts_with("boundary,s,x,y,Cp,Mach\nwall,0,0,0,"), world().is_root()) << table;
  EXPECT_TRUE(flow.warnings.empty());
}

TEST(WallQuantities, LeaveWhatTheSolverTells) {
  const Mesh mesh = spread_grid();
  const flow::SolvedFlow flow = with_wall_quantities(cell_solver(0.5), stream)(world(), mesh, {}, 0);
  EXPECT_EQ(flow.cl, 0.5);
  EXPECT_EQ(flow.cd, -1);
  EXPECT_EQ(flow.forces.size(), 1U);
}

TEST(WallQuantities, AreNoneWithoutVelocityAndPressure) {
  const Mesh mesh = spread_grid();
  const flow::FlowSolver heat = [](const Communicator&, const Mesh& part, const Field&, int) {
    flow::SolvedFlow flow;
    flow.solution.names = {"T"};
    flow.solution.values.resize(part.owned_nodes, 1.0);
    return flow;
  };
  const flow::SolvedFlow flow = with_wall_quantities(heat, stream)(world(), mesh, {}, 0);
  EXPECT_FALSE(flow.stream);
  EXPECT_FALSE(flow.cl);
  EXPECT_TRUE(flow.at_walls.empty());
  ASSERT_EQ(flow.warnings.size(), 1U);
  EXPECT_TRUE(flow.warnings[0].starts_with("no forces and no values along walls: the flow"))
      << flow.warnings[0];
}

}  // namespace
}  // namespace quadloop::adapt
