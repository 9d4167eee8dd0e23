// The thickness of the boundary layer in a solution, and layers of the next mesh that follow it.
#include "adapt/remesh/boundary_layer/measured_thickness.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adapt/remesh/boundary_layer/layer_edge.hpp"
#include "adapt/remesh/followed_walls.hpp"
#include "adapt/remesh/remesh.hpp"
#include "generate/outside_layers.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

constexpr double first_height = 0.0025, growth = 1.2;
constexpr int layer_count = 16;

/// A channel from x = 0 to 4, y = 0 to 2, with layers on its floor, 0.22 thick in the first mesh.
MeshInput layered_channel() {
  Boundary floor{"floor", 0.1, 30, "wall"}, rest{"rest", 0.25, 30, "none"};
  floor.layers = LayerSpec{first_height, growth, growth, layer_count};
  floor.layers->follows_flow = true;
  const std::vector<BoundaryId> of_segment{BoundaryId{0}, BoundaryId{1}, BoundaryId{1}, BoundaryId{1}};
  MeshInput input{{{floor, rest}, {{0, 0}, {4, 0}, {4, 2}, {0, 2}}, {0, 4}, of_segment}, {}, {}, 0};
  input.mesh.size.min = 0.02;
  input.mesh.size.max = 0.25;
  return input;
}

AdaptOptions density_options() {
  AdaptOptions chosen;
  chosen.variables = {"density"};
  return chosen;
}

/// Half of the distance in which the velocity tanh(y / scale) reaches 96 %.
double scale(double x) { return 0.05 + 0.01 * x; }

/// The edge of that profile, by its definition on many samples.
double exact_edge(double x) {
  std::vector<ProfileSample> profile;
  for (double y = 1e-3; y < 2; y += 1e-3)
    profile.push_back({y, std::tanh(y / scale(x)), 1 / (scale(x) * std::pow(std::cosh(y / scale(x)), 2))});
  return *layer_edge(profile);
}

SolvedMesh solved_layer(const Communicator& comm, const MeshInput& input, double thicker = 1,
                        const std::vector<std::string>& names = {"density", "x_velocity", "y_velocity"}) {
  MeshResult made = generate_mesh(comm, input).result;
  SolvedMesh solved{std::move(made.mesh), std::move(made.tree), {names, {}, {}}, "flow.mesh"};
  for (std::int32_t i = 0; i < solved.mesh.owned_nodes; ++i) {
    const Point p = solved.mesh.point(NodeId{i});
    solved.solution.values.insert(solved.solution.values.end(),
                                  {1.0, std::tanh(p.y / (thicker * scale(p.x))), 0.0});
  }
  return solved;
}

/// Cells at the edge are a third of the thickness high; the ends of the floor have the values of the next
/// node.
constexpr double within = 0.08;

TEST(MeasuredThickness, IsThatOfTheProfileAtEachWallNode) {
  const MeshInput input = layered_channel();
  const std::vector<MeasuredThickness> found =
      measured_thickness(world(), input.geometry, solved_layer(world(), input));
  ASSERT_GT(found.size(), 30U);
  double reached = 0;
  for (const MeasuredThickness& edge : found) {
    reached += edge.to.x - edge.from.x;
    EXPECT_EQ(edge.from.y, 0);
    EXPECT_NEAR(edge.at_from, exact_edge(edge.from.x), within * exact_edge(edge.from.x)) << edge.from.x;
    EXPECT_NEAR(edge.at_to, exact_edge(edge.to.x), within * exact_edge(edge.to.x)) << edge.to.x;
  }
  EXPECT_NEAR(reached, 4, 1e-12);
}

TEST(MeasuredThickness, HasTheSameBitsOnAnyNumberOfRanks) {
  const MeshInput input = layered_channel();
  const Communicator alone(MPI_COMM_SELF);
  EXPECT_EQ(measured_thickness(world(), input.geometry, solved_layer(world(), input)),
            measured_thickness(alone, input.geometry, solved_layer(alone, input)));
}

/// The nearest other boundary is the ceiling, above which half of the channel the layer is not sought.
TEST(MeasuredThickness, IsUnknownIfTheLayerReachesBeyondTheMiddleOfAGap) {
  const MeshInput input = layered_channel();
  for (const MeasuredThickness& edge :
       measured_thickness(world(), input.geometry, solved_layer(world(), input, 20))) {
    EXPECT_EQ(edge.at_from, 0);
    EXPECT_EQ(edge.at_to, 0);
  }
}

TEST(ThicknessToFollow, IsThatOfTheLastMeshWhereItIsUnknownAndWithAWarningWithoutVelocity) {
  const MeshInput input = layered_channel();
  std::vector<std::string> warnings;
  SolvedMesh flow = solved_layer(world(), input, 20);
  flow.tree.measured.thickness = {{{0, 0}, {4, 0}, 0.1, 0.3}};
  for (const MeasuredThickness& edge : thickness_to_follow(world(), input, flow, warnings))
    EXPECT_NEAR(edge.at_from, 0.1 + 0.05 * edge.from.x, 1e-12);
  EXPECT_TRUE(warnings.empty());
  SolvedMesh other = solved_layer(world(), input, 1, {"density", "a", "b"});
  other.tree.measured = flow.tree.measured;
  EXPECT_EQ(thickness_to_follow(world(), input, other, warnings), flow.tree.measured.thickness);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("flow.mesh: the solution has no variables x_velocity and y_velocity"),
            std::string::npos)
      << warnings[0];
}

TEST(ThicknessToFollow, GivesTheNextMeshLayersThatEndAtTheEdge) {
  const MeshInput input = layered_channel();
  const SolvedMesh flow = solved_layer(world(), input);
  const AdaptationPlan plan = plan_adaptation(world(), input, density_options(), flow);
  EXPECT_TRUE(plan.new_layers);
  const RemeshedSolution next = remesh_and_transfer(world(), input, plan, flow);
  const MeshResult& made = next.generated.result;
  EXPECT_EQ(made.tree.measured, plan.measured);
  const LayerFront front = front_of(world(), input, input.geometry, plan.measured, {});
  for (std::int32_t i = 0; i < front.line.size(); ++i) {
    const Station& station = front.line[i];
    const double wanted = 1.2 * exact_edge(station.wall.x);
    EXPECT_NEAR(front.thickness[i], wanted, within * wanted) << station.wall.x;
    const LayerSpec& layers = front.line.spec(i);
    EXPECT_EQ(layers.first, first_height);
    EXPECT_EQ(layers.count, layer_count);
    EXPECT_LE(layers.growth, 1.3);
    EXPECT_GE(layers.growth, 1.14);
  }
  const AdaptationPlan standing = unchanged_plan(made.tree, input);
  const MeshResult again =
      generate_mesh(world(), input, DemandedSplits(world(), standing.demands), standing.measured).result;
  EXPECT_EQ(again.tree.attributes.coordinate_digest, made.tree.attributes.coordinate_digest);
  const Communicator alone(MPI_COMM_SELF);
  const SolvedMesh of_one = solved_layer(alone, input);
  const AdaptationPlan plan_of_one = plan_adaptation(alone, input, density_options(), of_one);
  EXPECT_EQ(remesh_and_transfer(alone, input, plan_of_one, of_one)
                .generated.result.tree.attributes.coordinate_digest,
            made.tree.attributes.coordinate_digest);
}

TEST(ThicknessToFollow, ASmallChangeIsNoOtherMesh) {
  const MeshInput input = layered_channel();
  MeasuredFlow before, now;
  before.thickness = now.thickness =
      measured_thickness(world(), input.geometry, solved_layer(world(), input));
  for (MeasuredThickness& edge : now.thickness) edge.at_from *= 1.08, edge.at_to *= 1.08;
  EXPECT_FALSE(other_heights(input, before, now));
  for (MeasuredThickness& edge : now.thickness) edge.at_from *= 1.08, edge.at_to *= 1.08;
  EXPECT_TRUE(other_heights(input, before, now));
}

}  // namespace
}  // namespace quadloop::adapt
