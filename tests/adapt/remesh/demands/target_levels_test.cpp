// Sizes that the hessian asks for: leaves that jump by several levels, up and down, and a number of nodes
// that is met.
#include "adapt/remesh/demands/target_levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adapt/remesh/plan.hpp"
#include "adapt/remesh/remesh.hpp"
#include "adapt/sensor/target_size.hpp"
#include "mesher/base/error.hpp"
#include "tests/adapt/remesh/circular_shock.hpp"
#include "tests/adapt/remesh/square_input.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::circular_shock;
using test::world;

AdaptOptions sizes_for(std::int64_t nodes) {
  AdaptOptions options;
  options.variables = {"q"};
  options.min = 1.0 / 1024;
  options.norm = 2;
  options.max_nodes = nodes;
  return options;
}

/// The same for all leaves.
std::vector<std::int8_t> levels_of(const SolvedMesh& mesh, int level) {
  return std::vector<std::int8_t>(mesh.tree.leaves.size(), static_cast<std::int8_t>(level));
}

double quadratic(Point p) { return p.x * p.x; }
double linear(Point p) { return p.x; }

SolvedMesh solved(const Communicator& comm, const MeshInput& input, double (*value)(Point),
                  const AdaptationPlan* plan = nullptr) {
  const DemandedSplits demanded = plan != nullptr ? DemandedSplits(comm, plan->demands) : DemandedSplits{};
  MeshResult made = generate_mesh(comm, input, demanded).result;
  SolvedMesh solved{std::move(made.mesh), std::move(made.tree), {{"q"}, {}, {}}, "front.mesh"};
  for (std::int32_t i = 0; i < solved.mesh.owned_nodes; ++i)
    solved.solution.values.push_back(value(solved.mesh.point(NodeId{i})));
  return solved;
}

std::int64_t leaves_of_level(const TreeRecord& tree, int level) {
  return world().sum(std::int64_t{std::ranges::count(tree.leaves, level, &LeafRecord::level)});
}

TEST(SplitsForLevels, JumpUpAndDownByAnyNumber) {
  const MeshInput input = test::square_of_one_tree(1.0 / 16);
  const SolvedMesh base = solved(world(), input, linear);
  ASSERT_EQ(leaves_of_level(base.tree, 4), 256);
  std::vector<std::int8_t> levels(base.tree.leaves.size(), 0);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const LeafRecord& leaf = base.tree.leaves[i];
    if (leaf.x == 0 && leaf.y == 0) levels[i] = 8;  // the one in the corner
  }
  AdaptationPlan plan;
  const ChangedSplits up = splits_for_levels(world(), base.tree, levels);
  EXPECT_EQ(up.refined, 1);
  EXPECT_EQ(up.coarsened, 0);
  plan.demands = up.demands;
  const SolvedMesh fine = solved(world(), input, linear, &plan);
  EXPECT_GE(leaves_of_level(fine.tree, 8), 256) << "as many as four levels make";
  EXPECT_LE(leaves_of_level(fine.tree, 8), 400) << "and what lies between them and larger ones";
  EXPECT_EQ(leaves_of_level(fine.tree, 9), 0);
  EXPECT_GT(leaves_of_level(fine.tree, 4), 200);

  const ChangedSplits stay = splits_for_levels(world(), fine.tree, [&] {
    std::vector<std::int8_t> same;
    for (const LeafRecord& leaf : fine.tree.leaves) same.push_back(leaf.level);
    return same;
  }());
  EXPECT_EQ(stay.refined + stay.coarsened, 0);

  const ChangedSplits down =
      splits_for_levels(world(), fine.tree, std::vector<std::int8_t>(fine.tree.leaves.size(), 0));
  EXPECT_EQ(down.refined, 0);
  EXPECT_GE(down.coarsened, 256);
  plan.demands = down.demands;
  const SolvedMesh again = solved(world(), input, linear, &plan);
  EXPECT_EQ(again.mesh.points, base.mesh.points) << "nothing is left of it";
}

TEST(TargetLevels, FollowTheFormula) {
  const MeshInput input = test::square_of_one_tree(1.0 / 16);
  const SolvedMesh mesh = solved(world(), input, quadratic);  // of one size everywhere
  const TargetLevels wanted(world(), sizes_for(1000), mesh, levels_of(mesh, 10));
  EXPECT_FALSE(wanted.flat());
  // x^2 on squares of 1/16: the mean error is h^2 |q''| / 12.
  EXPECT_NEAR(wanted.error(), 2.0 / 256 / 12, 1e-8);
  for (const int level : {0, 3, 6}) {
    const double complexity = 0.999 * std::ldexp(1.0, 2 * level);  // sizes just over an edge of that level
    for (const std::int8_t found : wanted.levels(complexity)) EXPECT_EQ(found, level);
    EXPECT_NEAR(wanted.leaves_at(complexity), std::ldexp(1.0, 2 * level), 1e-6);
    const CellValues cells = wanted.of_cells(complexity);
    ASSERT_EQ(cells.names, (std::vector<std::string>{"interpolation_error", "wanted_size"}));
    for (std::size_t i = 1; i < cells.values.size(); i += 2)
      EXPECT_NEAR(cells.values[i], std::min(1.0, std::pow(complexity, -0.5)), 1e-6);
  }
  for (const std::int8_t found : wanted.levels(1e12)) EXPECT_EQ(found, 10) << "the finest";
  for (const std::int8_t found : wanted.levels(0)) EXPECT_EQ(found, 0);
}

TEST(TargetLevels, OfALinearFieldAskForNothing) {
  const MeshInput input = test::square_of_one_tree(1.0 / 16);
  const SolvedMesh mesh = solved(world(), input, linear);
  EXPECT_TRUE(TargetLevels(world(), sizes_for(1000), mesh, levels_of(mesh, 10)).flat());
  const AdaptationPlan plan = plan_adaptation(world(), input, sizes_for(1000), mesh);
  EXPECT_FALSE(plan.changes_mesh());
  EXPECT_EQ(plan.estimate, 0);
  EXPECT_NE(plan.reason_for_no_change.find("no variable has a second derivative"), std::string::npos);
}

TEST(SizePlan, MeetsTheNumberOfNodesAndLowersTheError) {
  const MeshInput input = test::square_of_one_tree(1.0 / 16);
  const SolvedMesh coarse = solved(world(), input, circular_shock);
  const AdaptationPlan plan = plan_adaptation(world(), input, sizes_for(3000), coarse);
  EXPECT_GT(plan.refined, 0);
  ASSERT_TRUE(plan.estimate.has_value());
  const SolvedMesh fine = solved(world(), input, circular_shock, &plan);
  const std::int64_t nodes = fine.tree.attributes.nodes;
  EXPECT_LE(nodes, 3000);
  EXPECT_GE(nodes, 2550);
  const AdaptationPlan next = plan_adaptation(world(), input, sizes_for(6000), fine);
  EXPECT_LT(*next.estimate, 0.2 * *plan.estimate);
  // Fewer nodes than there are: leaves go that adaptation had made.
  const AdaptationPlan fewer = plan_adaptation(world(), input, sizes_for(1500), fine);
  EXPECT_GT(fewer.coarsened, 0);
  const std::int64_t left = solved(world(), input, circular_shock, &fewer).tree.attributes.nodes;
  EXPECT_LE(left, 1500);
  EXPECT_GE(left, 1200) << "few leaves, and large steps";
}

/// That of the error of sizes which follow the front, over that of one size everywhere with as many nodes.
TEST(SizePlan, ConvergesWithSecondOrder) {
  const MeshInput input = test::square_of_one_tree(1.0 / 16);
  SolvedMesh mesh = solved(world(), input, circular_shock);
  AdaptationPlan plan = plan_adaptation(world(), input, sizes_for(2000), mesh);
  std::vector<double> errors, nodes;
  for (const std::int64_t wanted : {2000, 4000, 8000, 16000}) {
    plan = plan_adaptation(world(), input, sizes_for(wanted), mesh);
    mesh = solved(world(), input, circular_shock, &plan);
    nodes.push_back(static_cast<double>(mesh.tree.attributes.nodes));
    errors.push_back(*plan_adaptation(world(), input, sizes_for(wanted), mesh).estimate);
  }
  const double order = std::log(errors[1] / errors[3]) / (0.5 * std::log(nodes[3] / nodes[1]));
  EXPECT_NEAR(order, 2, 0.4);
}

TEST(SizePlan, GrowsByNoMoreThanItMay) {
  const MeshInput input = test::square_of_one_tree(1.0 / 16);
  const SolvedMesh mesh = solved(world(), input, circular_shock);  // 289 nodes
  AdaptOptions options = sizes_for(5000);
  options.growth = 2;
  const AdaptationPlan plan = plan_adaptation(world(), input, options, mesh);
  const std::int64_t nodes = solved(world(), input, circular_shock, &plan).tree.attributes.nodes;
  EXPECT_LE(nodes, 578);
  EXPECT_GE(nodes, 500);
}

TEST(SizePlan, SaysWhenCaseAndGeometryPassTheCap) {
  const MeshInput input = test::square_of_one_tree(1.0 / 16);
  const AdaptationPlan plan =
      plan_adaptation(world(), input, sizes_for(20), solved(world(), input, circular_shock));
  EXPECT_EQ(plan.refined, 0);
  ASSERT_FALSE(plan.warnings.empty());
  EXPECT_NE(plan.warnings[0].find("adapt.max_nodes is 20"), std::string::npos) << plan.warnings[0];
}

TEST(SizePlan, KeepsToWhatIsAllowedAndSaysSo) {
  MeshInput input = test::square_of_one_tree(1.0 / 16);
  const SolvedMesh mesh = solved(world(), input, circular_shock);
  input.mesh.limit.cells = 1500;
  const AdaptationPlan plan = plan_adaptation(world(), input, sizes_for(20000), mesh);
  ASSERT_FALSE(plan.warnings.empty());
  EXPECT_NE(plan.warnings[0].find("--max-cells"), std::string::npos) << plan.warnings[0];
  EXPECT_GT(plan.refined, 0);
  input.mesh.limit.cells = MeshLimit::none;
  EXPECT_LT(solved(world(), input, circular_shock, &plan).tree.attributes.nodes, 2500);
  EXPECT_TRUE(plan_adaptation(world(), input, sizes_for(3000), mesh).warnings.empty());
}

TEST(SizePlan, IsTheSameOnAnyNumberOfRanks) {
  const MeshInput input = test::square_of_one_tree(1.0 / 16);
  const Communicator alone(MPI_COMM_SELF);
  const auto points_by = [&](const Communicator& comm) {
    const AdaptationPlan plan =
        plan_adaptation(comm, input, sizes_for(2000), solved(comm, input, circular_shock));
    const SolvedMesh next = solved(comm, input, circular_shock, &plan);
    std::vector<Point> points =
        comm.all_gather_values(std::span(next.mesh.points).first(next.mesh.owned_nodes));
    points.push_back({*plan.estimate, 0});
    return points;
  };
  EXPECT_EQ(points_by(world()), points_by(alone));
}

TEST(SizePlan, NamesTheFileOfAMissingVariable) {
  const MeshInput input = test::square_of_one_tree(1.0 / 16);
  AdaptOptions options = sizes_for(1000);
  options.variables = {"entropy"};
  const SolvedMesh mesh = solved(world(), input, circular_shock);
  try {
    plan_adaptation(world(), input, options, mesh);
    FAIL();
  } catch (const InputError& fault) {
    EXPECT_TRUE(std::string(fault.what()).starts_with("front.mesh: ")) << fault.what();
  }
}

}  // namespace
}  // namespace quadloop::adapt
