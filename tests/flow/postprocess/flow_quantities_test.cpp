// What follows from a flow at nodes, and the forces of any solver's flow.
#include "flow/postprocess/flow_quantities.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flow/postprocess/boundary_forces.hpp"
#include "flow/postprocess/free_stream.hpp"
#include "flow/postprocess/history.hpp"
#include "flow/postprocess/run_constants.hpp"
#include "mesher/base/error.hpp"
#include "tests/flow/postprocess/dense_stream.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow {
namespace {

using test::world;

const FreeStream inviscid_stream = test::dense_stream(0);

TEST(Quantities, AreMachNumberAndPressureCoefficient) {
  const Field flow{{"rho", "u", "v", "p"}, {1.5, 3, 4, 4, 2, 0, 0, 3}, {7}};
  const Field all = with_quantities(flow, quantity_names(), inviscid_stream);
  EXPECT_EQ(all.names, (std::vector<std::string>{"rho", "u", "v", "p", "mach", "pressure_coefficient"}));
  EXPECT_EQ(all.constants, flow.constants);
  EXPECT_DOUBLE_EQ(all.row(NodeId{0})[4], 5 / std::sqrt(1.5 * 4 / 1.5));
  EXPECT_DOUBLE_EQ(all.row(NodeId{0})[5], 1.0 / 16);
  EXPECT_EQ(all.row(NodeId{1})[4], 0);
  EXPECT_EQ(all.row(NodeId{1})[5], 0);
  EXPECT_EQ(all.row(NodeId{1})[3], 3);
}

TEST(Quantities, ReplaceThoseThatAreThere) {
  const Field flow{{"mach", "rho", "u", "v", "p"}, {99, 1, 1, 0, 1 / 1.5}, {}};
  const Field all = with_quantities(flow, {mach_name}, inviscid_stream);
  EXPECT_EQ(all.names, (std::vector<std::string>{"rho", "u", "v", "p", "mach"}));
  EXPECT_DOUBLE_EQ(all.values.back(), 1);
  EXPECT_EQ(with_quantities(flow, {}, inviscid_stream).names, flow.names);
}

TEST(Quantities, OfAFlowInCellsStandThere) {
  Field flow;
  flow.cells = {{"T", "p", "U_x", "U_y", "rho"}, {9, 4, 3, 4, 1.5, 9, 3, 0, 0, 2}};
  const Field all = with_quantities(flow, quantity_names(), inviscid_stream);
  EXPECT_TRUE(all.names.empty());
  EXPECT_EQ(all.cells.names,
            (std::vector<std::string>{"T", "p", "U_x", "U_y", "rho", "mach", "pressure_coefficient"}));
  EXPECT_DOUBLE_EQ(all.cells.values.at(5), 5 / std::sqrt(1.5 * 4 / 1.5));
  EXPECT_DOUBLE_EQ(all.cells.values.at(6), 1.0 / 16);
  EXPECT_EQ(all.cells.values.at(7), 9);
}

TEST(Quantities, OfGasAtRestAndOfAFlowWithoutDensityAreZero) {
  EXPECT_EQ(pressure_coefficient(5, FreeStream{}), 0);
  const Field flow{{"u", "v", "p"}, {3, 4, 1}, {}};
  EXPECT_EQ(FlowColumns(flow, "it").mach(flow.row(NodeId{0}), 1.4), 0);
  EXPECT_EQ(FlowColumns(flow, "it").density(flow.row(NodeId{0}), inviscid_stream), 2);
  EXPECT_THROW(FlowColumns(std::vector<std::string>{"u", "p"}, "it"), InputError);
}

/// A grid on the unit square, south and east side "wall".
Mesh part_of(const test::Grid& grid) {
  const Mesh whole = grid.mesh();
  return scatter_mesh(world(), whole, test::shuffled_order(whole, 5));
}

Field flow_on(const Mesh& mesh, bool viscous) {
  Field flow{{"density", "x_velocity", "y_velocity", "pressure"}, {}, {}};
  if (viscous) flow.names.emplace_back("wall_shear");
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    const Point at = mesh.points[i];
    flow.values.insert(flow.values.end(), {1, 1, 0, inviscid_stream.pressure + at.x + 2 * at.y});
    if (viscous) flow.values.push_back(0.25);
  }
  return flow;
}

TEST(BoundaryForces, AreThePressureLessTheFreeStreams) {
  const Mesh mesh = part_of({7});
  const auto forces = boundary_forces(world(), mesh, flow_on(mesh, false), inviscid_stream, {"wall", "far"});
  ASSERT_EQ(forces.size(), 2U);
  EXPECT_EQ(forces[0].boundary, "wall");
  const double scale = 1 / (inviscid_stream.dynamic_pressure() * inviscid_stream.reference_length);
  EXPECT_NEAR(forces[0].cl, -0.5 * scale, 1e-14) << "south: the mean of x";
  EXPECT_NEAR(forces[0].cd, (1 + 1) * scale, 1e-14) << "east: 1 + the mean of 2y";
  EXPECT_NEAR(forces[1].cl, 2.5 * scale, 1e-14);
  EXPECT_NEAR(forces[1].cd, -1 * scale, 1e-14);
  EXPECT_EQ(forces[0].cd_friction, 0);
}

TEST(BoundaryForces, TurnWithTheWindAndHaveFriction) {
  const Mesh mesh = part_of({4});
  FreeStream turned = inviscid_stream;
  turned.alpha = 30;
  const Field flow = flow_on(mesh, true);
  const BoundaryForce along = boundary_forces(world(), mesh, flow, inviscid_stream, {"wall"}).at(0),
                      across = boundary_forces(world(), mesh, flow, turned, {"wall"}).at(0);
  const double c = std::cos(std::numbers::pi / 6), s = 0.5;
  const double drag = along.cd - along.cd_friction, lift = along.cl - along.cl_friction;
  EXPECT_NEAR(across.cd - across.cd_friction, c * drag + s * lift, 1e-14);
  EXPECT_NEAR(across.cl - across.cl_friction, c * lift - s * drag, 1e-14);
  const double scale = 1 / (inviscid_stream.dynamic_pressure() * inviscid_stream.reference_length);
  EXPECT_NEAR(along.cd_friction, 0.25 * scale, 1e-14) << "the south side";
  EXPECT_NEAR(along.cl_friction, 0.25 * scale, 1e-14) << "the east side, walked upwards";
}

TEST(BoundaryForces, HaveTheSameBitsHoweverTheMeshIsSpread) {
  const test::Grid grid{9};
  Mesh whole = grid.mesh();
  test::jitter(grid, 0.2, 3, whole);
  const Mesh one = scatter_mesh(world(), whole, space_filling_order(whole)),
             other = scatter_mesh(world(), whole, test::shuffled_order(whole, 4));
  const auto a = boundary_forces(world(), one, flow_on(one, true), inviscid_stream, {"wall"}).at(0),
             b = boundary_forces(world(), other, flow_on(other, true), inviscid_stream, {"wall"}).at(0);
  EXPECT_EQ(a.cl, b.cl);
  EXPECT_EQ(a.cd, b.cd);
}

TEST(History, IsATableWithATimeWhereOneCounts) {
  EXPECT_EQ(history_table({{1, 0.5, 0.25, 2}}), "step,residual,cl,cd\n1,0.5,0.25,2\n");
  EXPECT_EQ(history_table({{1, 0.5, 0, 0, 0.125}}), "step,residual,cl,cd,time\n1,0.5,0,0,0.125\n");
}

TEST(RunConstants, ComeBackFromTheOrderThatFilesHave) {
  const std::optional<RunConstants> run = RunConstants::of({200, 0.5, 0.8, 1.25, 0.36, 0.024, 1e-9});
  ASSERT_TRUE(run);
  EXPECT_EQ(run->steps, 200);
  EXPECT_EQ(run->mach, 0.8);
  EXPECT_EQ(run->residual, 1e-9);
  EXPECT_EQ(RunConstants::of(run->values())->values(), run->values());
  EXPECT_FALSE(RunConstants::of({200, 0.5, 0.8})) << "of another solver";
}

}  // namespace
}  // namespace quadloop::flow
