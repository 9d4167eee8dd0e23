// Wakes that follow the flow of one mesh in the next one.
#include "adapt/remesh/followed_wakes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adapt/remesh/remesh.hpp"
#include "tests/layers/walls.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

/// A box round a body with a sharp edge at (2, 0), whose wake follows the flow.
MeshInput input_with_wake() {
  MeshInput input{test::rhombus_with_layers(test::equal_layers(0.1, 4), 0.3), {}, {}, 0};
  input.mesh.size.min = 0.02;
  input.mesh.size.max = 1;
  LayerLine wake;
  wake.from = {"body"};
  wake.at = Point{2, 0};
  wake.length = 3;
  wake.spacing = 0.2;
  wake.where = "case.toml:9";
  wake.follows_flow = true;
  input.lines = {wake};
  return input;
}

/// The same with a wake without layers.
MeshInput input_with_sizes() {
  MeshInput input = input_with_wake();
  LayerLine wake = input.lines[0];
  wake.without_layers = true;
  wake.spacing_at_end = 0.4;
  input.lines.clear();
  input.wakes_without_layers = {wake};
  return input;
}

/// A uniform flow at an angle, in degrees.
SolvedMesh solved(MeshResult made, double degrees) {
  SolvedMesh solved{std::move(made.mesh), std::move(made.tree), {{"density", "u", "v"}, {}, {}}, "flow.mesh"};
  const double angle = degrees * 0.017453292519943295;
  for (std::int32_t i = 0; i < solved.mesh.owned_nodes; ++i)
    solved.solution.values.insert(solved.solution.values.end(), {1, std::cos(angle), std::sin(angle)});

  return solved;
}

SolvedMesh solved(const Communicator& comm, const MeshInput& input, double degrees) {
  return solved(generate_mesh(comm, input).result, degrees);
}

AdaptOptions by_density() {
  AdaptOptions options;
  options.variables = {"density"};
  return options;
}

void expect_wake_of_flow(const MeshInput& input) {
  const SolvedMesh flow = solved(world(), input, 8);
  EXPECT_TRUE(flow.tree.measured.empty());
  const AdaptationPlan plan = plan_adaptation(world(), input, by_density(), flow);
  EXPECT_TRUE(plan.new_layers);
  EXPECT_TRUE(plan.changes_mesh());
  EXPECT_TRUE(plan.warnings.empty());
  ASSERT_EQ(plan.measured.wakes.size(), 1U);
  const std::vector<Point>& path = plan.measured.wakes[0];
  EXPECT_EQ(path[0], (Point{2, 0}));
  EXPECT_NEAR(std::atan2(path[20].y - path[8].y, path[20].x - path[8].x), 0.13962634, 1e-6);
  const MeshResult made = remesh_and_transfer(world(), input, plan, flow).generated.result;
  EXPECT_EQ(made.tree.measured, plan.measured);
  const AdaptationPlan standing = unchanged_plan(made.tree, input);
  const MeshResult again =
      generate_mesh(world(), input, DemandedSplits(world(), standing.demands), standing.measured).result;
  EXPECT_EQ(again.tree.attributes.coordinate_digest, made.tree.attributes.coordinate_digest);
  const Communicator alone(MPI_COMM_SELF);
  const SolvedMesh of_one = solved(alone, input, 8);
  const AdaptationPlan plan_of_one = plan_adaptation(alone, input, by_density(), of_one);
  EXPECT_EQ(plan_of_one.measured, plan.measured) << "to the last bit";
  EXPECT_EQ(remesh_and_transfer(alone, input, plan_of_one, of_one)
                .generated.result.tree.attributes.coordinate_digest,
            made.tree.attributes.coordinate_digest);
}

TEST(FollowedWakes, TheNextMeshHasTheFlowsWakeAndSoHasItsRestart) {
  expect_wake_of_flow(input_with_wake());
  expect_wake_of_flow(input_with_sizes());
}

TEST(FollowedWakes, WakesWithAndWithoutLayersStandSideBySide) {
  MeshInput input = input_with_wake();
  input.wakes_without_layers = input_with_sizes().wakes_without_layers;
  input.wakes_without_layers[0].at = Point{-2, 0};
  const FollowedWakes both = wakes_to_follow(world(), input, solved(world(), input, 8));
  ASSERT_EQ(both.paths.size(), 1U) << "the other one is against the flow and knows no course";
  EXPECT_EQ(both.paths[0][0], (Point{2, 0}));
  EXPECT_EQ(both.warnings.size(), 1U);
  input.lines[0].at = Point{-2, 0};
  input.wakes_without_layers[0].at = Point{2, 0};
  const FollowedWakes others = wakes_to_follow(world(), input, solved(world(), input, 8));
  ASSERT_EQ(others.paths.size(), 2U);
  EXPECT_EQ(others.paths[0], (std::vector<Point>{{-2, 0}, {-5, 0}})) << "it keeps its course";
  EXPECT_EQ(others.paths[1][0], (Point{2, 0}));
}

void expect_small_changes_ignored(const MeshInput& input) {
  const AdaptationPlan plan = plan_adaptation(world(), input, by_density(), solved(world(), input, 8));
  const auto changes = [&](double degrees) {
    MeshResult made = generate_mesh(world(), input, {}, plan.measured).result;
    return plan_adaptation(world(), input, by_density(), solved(std::move(made), degrees)).new_layers;
  };
  EXPECT_FALSE(changes(8));
  EXPECT_FALSE(changes(8.2));
  EXPECT_TRUE(changes(12));
}

TEST(FollowedWakes, SmallChangesOfTheFlowChangeNoMesh) {
  expect_small_changes_ignored(input_with_wake());
  expect_small_changes_ignored(input_with_sizes());
}

TEST(FollowedWakes, KeepTheirCourseWithoutAFlowToFollow) {
  const MeshInput input = input_with_wake();
  SolvedMesh flow = solved(world(), input, 180);
  const std::vector<Point> before{{2, 0}, {3, 0.1}, {4.9, 0.2}};
  flow.tree.measured.wakes = {before};
  const FollowedWakes reversed = wakes_to_follow(world(), input, flow);
  EXPECT_EQ(reversed.paths, (std::vector<std::vector<Point>>{before}));
  ASSERT_EQ(reversed.warnings.size(), 1U);
  EXPECT_EQ(
      reversed.warnings[0].find("case.toml:9: wake keeps its course, as the flow behind its trailing edge "
                                "at (2, 0) is at rest, reversed"),
      0U)
      << reversed.warnings[0];
  flow.solution.names = {"density", "a", "b"};
  const FollowedWakes silent = wakes_to_follow(world(), input, flow);
  EXPECT_EQ(silent.paths, (std::vector<std::vector<Point>>{before}));
  ASSERT_EQ(silent.warnings.size(), 1U);
  EXPECT_NE(silent.warnings[0].find("the solution has no velocity"), std::string::npos);
}

}  // namespace
}  // namespace quadloop::adapt
