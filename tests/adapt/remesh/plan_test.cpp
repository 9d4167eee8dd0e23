// From a solution to demands: marks in a row from few to many, caps kept, meshes that are not the tree's
// refused.
#include "adapt/remesh/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <regex>
#include <string>
#include <utility>
#include <vector>

#include "adapt/remesh/demands/mark_family.hpp"
#include "adapt/remesh/own_mesh.hpp"
#include "adapt/remesh/remesh.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/facets.hpp"
#include "mesher/grid/tree_grid.hpp"
#include "tests/adapt/remesh/circular_shock.hpp"
#include "tests/adapt/remesh/square_input.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

MeshInput square_input() { return test::square_input(1.0 / 16); }

AdaptOptions adapt_options() {
  AdaptOptions options;
  options.variables = {"q"};
  options.min = 1.0 / 128;
  return options;
}

/// A front across a quarter circle, on the mesh of `input`.
SolvedMesh solved_on(MeshResult made) {
  SolvedMesh solved{std::move(made.mesh), std::move(made.tree), {{"q"}, {}, {}}, "front.mesh"};
  for (std::int32_t i = 0; i < solved.mesh.owned_nodes; ++i)
    solved.solution.values.push_back(test::circular_shock(solved.mesh.point(NodeId{i})));
  return solved;
}
SolvedMesh solved_shock(const Communicator& comm, const MeshInput& input) {
  return solved_on(generate_mesh(comm, input).result);
}

struct Counts {
  std::int64_t refined = 0, coarsened = 0;
};
Counts counts_of(const std::vector<RefinementFlag>& flags) {
  return {world().sum(std::int64_t{std::count(flags.begin(), flags.end(), RefinementFlag::refine)}),
          world().sum(std::int64_t{std::count(flags.begin(), flags.end(), RefinementFlag::coarsen)})};
}

TEST(MarkFamily, GoesFromFewLeavesToMany) {
  const SolvedMesh solved = solved_shock(world(), square_input());
  const MarkFamily family(world(), adapt_options(), solved);
  EXPECT_FALSE(family.flat());
  Counts before = counts_of(family.flags(-1));
  EXPECT_EQ(before.refined, 0);
  EXPECT_EQ(before.coarsened, world().sum(std::ssize(solved.tree.leaves))) << "in the end all";
  for (double at = -0.9; at <= 1.01; at += 0.1) {
    const Counts now = counts_of(family.flags(std::min(at, 1.0)));
    EXPECT_GE(now.refined, before.refined);
    EXPECT_LE(now.coarsened, before.coarsened);
    if (at < 0.05) {
      EXPECT_EQ(now.refined, 0) << at;
    }
    before = now;
  }
  EXPECT_GT(before.refined, 10);
}

TEST(MarkFamily, DropsTheSmallestIndicatorsFirst) {
  const SolvedMesh solved = solved_shock(world(), square_input());
  const MarkFamily family(world(), adapt_options(), solved);
  const auto all = family.flags(1), some = family.flags(0.4);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_TRUE(some[i] != RefinementFlag::refine || all[i] == RefinementFlag::refine);
  EXPECT_LT(counts_of(some).refined, counts_of(all).refined);
}

TEST(MarkFamily, OfAConstantMarksNothingToRefine) {
  SolvedMesh solved = solved_shock(world(), square_input());
  std::fill(solved.solution.values.begin(), solved.solution.values.end(), 4.0);
  const MarkFamily family(world(), adapt_options(), solved);
  EXPECT_TRUE(family.flat());
  EXPECT_EQ(counts_of(family.flags(1)).refined, 0);
}

TEST(MarkFamily, OfSizesGrowsThemSixteenfold) {
  SolvedMesh solved = solved_shock(world(), square_input());
  std::fill(solved.solution.values.begin(), solved.solution.values.end(),
            1.0 / 32);  // leaves are twice as large
  AdaptOptions options = adapt_options();
  options.source = AdaptOptions::Source::size;
  const MarkFamily family(world(), options, solved);
  const auto leaves = world().sum(std::ssize(solved.tree.leaves));
  EXPECT_EQ(counts_of(family.flags(1)).refined, leaves);
  EXPECT_EQ(counts_of(family.flags(0.4)).refined, 0);
  EXPECT_EQ(counts_of(family.flags(-1)).coarsened, leaves);
}

std::int64_t nodes_by(const AdaptationPlan& plan, const MeshInput& input) {
  return build_mesh(world(), input.geometry, input.mesh, DemandedSplits(world(), plan.demands))
      .tree.attributes.nodes;
}

TEST(Plan, RefinesTheFrontAlone) {
  const MeshInput input = square_input();
  const SolvedMesh solved = solved_shock(world(), input);
  const AdaptationPlan plan = plan_adaptation(world(), input, adapt_options(), solved);
  EXPECT_TRUE(plan.changes_mesh());
  EXPECT_GT(plan.refined, 10);
  EXPECT_TRUE(plan.warnings.empty());
  EXPECT_GT(nodes_by(plan, input), solved.tree.attributes.nodes);
}

TEST(Plan, KeepsToTheCapAndComesNearIt) {
  const MeshInput input = square_input();
  const SolvedMesh solved = solved_shock(world(), input);
  AdaptOptions options = adapt_options();
  const std::int64_t all = nodes_by(plan_adaptation(world(), input, options, solved), input);
  options.max_nodes = (solved.tree.attributes.nodes + all) / 2;
  const std::int64_t nodes = nodes_by(plan_adaptation(world(), input, options, solved), input);
  EXPECT_LE(nodes, *options.max_nodes);
  EXPECT_GT(nodes, solved.tree.attributes.nodes);
}

TEST(Plan, SaysWhenCaseAndGeometryPassTheCap) {
  const MeshInput input = square_input();
  AdaptOptions options = adapt_options();
  options.max_nodes = 20;
  const AdaptationPlan plan = plan_adaptation(world(), input, options, solved_shock(world(), input));
  EXPECT_EQ(plan.refined, 0);
  ASSERT_FALSE(plan.warnings.empty());
  EXPECT_NE(plan.warnings[0].find("adapt.max_nodes is 20"), std::string::npos) << plan.warnings[0];
}

TEST(Plan, SaysWhyTheMeshStays) {
  const MeshInput input = square_input();
  AdaptOptions options = adapt_options();
  options.min = 1.0 / 16;
  const auto plan = plan_adaptation(world(), input, options, solved_shock(world(), input));
  EXPECT_FALSE(plan.changes_mesh());
  ASSERT_EQ(plan.warnings.size(), 1U);
  EXPECT_NE(plan.warnings[0].find("adapt.min = 0.0625"), std::string::npos) << plan.warnings[0];
}

TEST(Plan, NamesTheFileOfAMissingVariable) {
  const MeshInput input = square_input();
  AdaptOptions options = adapt_options();
  options.variables = {"entropy"};
  const SolvedMesh solved = solved_shock(world(), input);
  try {
    plan_adaptation(world(), input, options, solved);
    FAIL();
  } catch (const InputError& fault) {
    EXPECT_TRUE(std::string(fault.what()).starts_with("front.mesh: ")) << fault.what();
  }
}

TEST(Remesh, CarriesTheSolutionOverByThePlan) {
  const MeshInput input = square_input();
  const SolvedMesh solved = solved_shock(world(), input);
  const RemeshedSolution remeshed =
      remesh_and_transfer(world(), input, plan_adaptation(world(), input, adapt_options(), solved), solved);
  const Mesh& mesh = remeshed.generated.result.mesh;
  ASSERT_EQ(remeshed.start.values.size(), static_cast<std::size_t>(mesh.owned_nodes));
  ASSERT_EQ(remeshed.drifts().size(), 1U);
  EXPECT_EQ(remeshed.drifts()[0].first, "q");
  EXPECT_LT(std::abs(remeshed.drifts()[0].second), 0.05);
  const RemeshedSolution again =
      remesh_and_transfer(world(), input, unchanged_plan(solved.tree, input), solved);
  EXPECT_EQ(again.generated.result.mesh.points, solved.mesh.points) << "without marks the mesh stays";
  EXPECT_EQ(again.start.values, solved.solution.values);
}

TEST(Remesh, WarnsOfAConservedIntegralThatDrifts) {
  RemeshedSolution remeshed;
  remeshed.start.names = {"p"};
  remeshed.start.cells.names = {"rho", "p"};
  TransferReport& report = remeshed.report;
  report.drift = report.relative_drift = {0.1, -3e-9, 2e-11};
  report.conserved_from = 1;
  const std::vector<std::string> warnings = drift_warnings(remeshed);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("integral of rho by -3e-09 of its magnitude;"), std::string::npos)
      << warnings[0];
  report.area_change = 1e-9;
  EXPECT_TRUE(drift_warnings(remeshed).empty()) << "the meshes differ in area by as much";
  report.area_change = 0;
  report.relative_drift = {0.1, 1e-8, 1e-7};
  EXPECT_NE(drift_warnings(remeshed).at(0).find("of cell_p by 1e-07 of its magnitude, and those of 1 more"),
            std::string::npos)
      << drift_warnings(remeshed)[0];
  report.relative_drift = {0.1, 9e-11, 0};
  EXPECT_TRUE(drift_warnings(remeshed).empty());
}

TEST(Remesh, KeepsConservedIntegralsBetweenSlantedSides) {
  MeshInput input = square_input();
  input.geometry = Geometry({{"far", 0, 30, "farfield"}}, {{0, 0}, {1, 0.1}, {1.07, 1.01}, {-0.02, 0.93}},
                            {0, 4}, std::vector<BoundaryId>(4, BoundaryId{0}));
  const SolvedMesh solved = solved_shock(world(), input);
  AdaptOptions options = adapt_options();
  options.transfer = TransferKind::conservative;
  const RemeshedSolution remeshed =
      remesh_and_transfer(world(), input, plan_adaptation(world(), input, options, solved), solved);
  EXPECT_NEAR(remeshed.report.relative_drift.at(0), 0, 1e-12);
  EXPECT_NEAR(remeshed.report.area_change, 0, 1e-12);
  EXPECT_TRUE(drift_warnings(remeshed).empty());
}

TEST(OwnMesh, IsTheOneThatTheTreeWasMadeWith) {
  SolvedMesh solved = solved_shock(world(), square_input());
  EXPECT_NO_THROW(require_own_mesh(world(), solved, "mesh", "tree"));
  EXPECT_NO_THROW(require_untouched_mesh(world(), solved, "mesh", "tree"));
  for (Point& p : solved.mesh.points) p.x += 1e-9;
  EXPECT_NO_THROW(require_own_mesh(world(), solved, "mesh", "tree")) << "other formats round";
  EXPECT_THROW(require_untouched_mesh(world(), solved, "mesh", "tree"), InputError);
  for (Point& p : solved.mesh.points) p.x += 0.5;
  EXPECT_THROW(require_own_mesh(world(), solved, "mesh", "tree"), InputError);
}

TEST(OwnMesh, CountsNodesAndCells) {
  SolvedMesh solved = solved_shock(world(), square_input());
  ++solved.tree.attributes.quads;
  try {
    require_own_mesh(world(), solved, "a.mesh", "a.tree.h5");
    FAIL();
  } catch (const InputError& fault) {
    EXPECT_TRUE(std::string(fault.what()).starts_with("a.mesh: belongs to another mesh than a.tree.h5: "))
        << fault.what();
  }
}

/// Targets of cells follow the solution: where no cell is marked too, but not where nothing bends.
TEST(Plan, TargetsMoveNodesWhereNoLeafIsMarked) {
  MeshInput input = square_input();
  input.stretch = 4;
  AdaptOptions options = adapt_options();
  options.refine = options.coarsen = 100;
  SolvedMesh solved = solved_shock(world(), input);
  const AdaptationPlan plan = plan_adaptation(world(), input, options, solved);
  EXPECT_EQ(plan.refined, 0);
  ASSERT_TRUE(std::holds_alternative<TargetDemand>(plan.anisotropy));
  EXPECT_EQ(std::get<TargetDemand>(plan.anisotropy).stretch, 4);
  EXPECT_TRUE(plan.changes_mesh());
  const RemeshedSolution next = remesh_and_transfer(world(), input, plan, solved);
  ASSERT_EQ(next.generated.result.mesh.points.size(), solved.mesh.points.size());
  const std::int64_t moved = next.generated.result.mesh.points != solved.mesh.points ? 1 : 0;
  EXPECT_GT(world().sum(moved), 0);
  std::ranges::fill(solved.solution.values, 2.0);
  EXPECT_FALSE(plan_adaptation(world(), input, options, solved).changes_mesh());
  input.stretch.reset();
  EXPECT_FALSE(std::holds_alternative<TargetDemand>(
      plan_adaptation(world(), input, options, solved_shock(world(), input)).anisotropy));
}

TEST(Plan, RefusesToFollowAMetricInFewerNodesThanTheCaseTakes) {
  MeshInput input = square_input();
  input.mesh.type = MeshType::metric;
  AdaptOptions options = adapt_options();
  options.norm = 2;
  const MeshResult first = generate_mesh(world(), input).result;
  ASSERT_EQ(first.tree.attributes.nodes, 289);
  const auto refusal = [&](std::int64_t nodes) -> std::string {
    options.max_nodes = nodes;
    try {
      require_room_for_metric(world(), input, options, first);
    } catch (const InputError& fault) {
      return fault.what();
    }
    return {};
  };
  const std::string refused = refusal(100), words = "set at least ";
  ASSERT_NE(refused.find(words), std::string::npos) << refused;
  const std::int64_t least = std::stoll(refused.substr(refused.find(words) + words.size()));
  EXPECT_GT(least, 200);
  EXPECT_LT(least, 320);
  EXPECT_EQ(refusal(least), "");
  EXPECT_EQ(refusal(400), "");
  input.mesh.type = MeshType::delaunay;
  EXPECT_EQ(refusal(100), "");
  // What is said to do does.
  input.mesh.type = MeshType::metric;
  options.max_nodes = least;
  const SolvedMesh solved = solved_shock(world(), input);
  const AdaptationPlan plan = plan_adaptation(world(), input, options, solved);
  const RemeshedSolution next = remesh_and_transfer(world(), input, plan, solved);
  EXPECT_LE(next.generated.result.tree.attributes.nodes, least);
}

/// A disc in the unit square by a polygon of 24 points, each of which turns by 15 degrees.
MeshInput polygon_input() {
  constexpr int corners = 24;
  std::vector<Point> points;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    points.push_back({0.5 + 0.5 * std::cos(angle), 0.5 + 0.5 * std::sin(angle)});
  }
  MeshInput input{
      {{{"side", 0, 30, "wall"}}, points, {0, corners}, std::vector<BoundaryId>(corners, BoundaryId{0})},
      {},
      {},
      0};
  input.mesh.size.min = input.mesh.size.max = 1.0 / 8;
  return input;
}

/// Of all splits demanded at facets the least size that they lead to, over half of the segment there.
double least_share_at_facets(const Communicator& comm, const MeshInput& input, const TreeRecord& tree,
                             const AdaptationPlan& plan) {
  const FacetZones facets(input.geometry);
  const TreeGrid grid(root_box(tree.attributes), tree.attributes.trees_x, tree.attributes.trees_y);
  double share = 1e9;
  for (const SplitDemand& demand : plan.demands) {
    const double least = facets.least_size(grid.box_of(demand.leaf));
    if (least > 0) share = std::min(share, grid.edge(std::bit_width(demand.levels)) / least);
  }
  return comm.minimum(share);
}

/// The place is a corner of the polygon, whose sides are sin(7.5 degrees) long.
constexpr const char* text_of_facets =
    R"(^boundary 'side': its points near \([-0-9.e]+, [-0-9.e]+\) are 0\.131 apart.*adapt\.facets = true)";

TEST(Plan, FacetsOfAPolygonAreNotResolved) {
  const MeshInput input = polygon_input();
  for (const bool by_sizes : {false, true}) {
    for (const bool may : {false, true}) {
      AdaptOptions options = adapt_options();
      options.min = 1.0 / 256;
      options.facets = may;
      if (by_sizes) {
        options.norm = 2;
        options.max_nodes = 1200;
      }
      double share = 1e9;
      bool told = false;
      SolvedMesh solved = solved_shock(world(), input);
      for (int cycle = 0; cycle < 3; ++cycle) {
        const AdaptationPlan plan = plan_adaptation(world(), input, options, solved);
        share = std::min(share, least_share_at_facets(world(), input, solved.tree, plan));
        for (const std::string& warning : plan.warnings)
          told = told || std::regex_search(warning, std::regex(text_of_facets));
        GeneratedMesh next = generate_mesh(world(), input, DemandedSplits(world(), plan.demands));
        solved = solved_on(std::move(next.result));
      }
      if (may) {
        EXPECT_LT(share, 1) << by_sizes;
      } else {
        EXPECT_GE(share, 1) << by_sizes;
      }
      if (!by_sizes) {
        EXPECT_EQ(told, !may);
      }
    }
  }
}

TEST(Plan, AMetricNeedsRoomBetweenItsSizes) {
  MeshInput input = square_input();
  AdaptOptions options = adapt_options();
  options.min = 2 * input.mesh.size.max;
  EXPECT_NO_THROW(require_min_in_tree(input, options)) << "marks tell why none takes effect";
  input.mesh.type = MeshType::metric;
  EXPECT_THROW(require_min_in_tree(input, options), InputError);
  options.min = input.mesh.size.max;
  EXPECT_NO_THROW(require_min_in_tree(input, options));
}

TEST(Plan, TellsShapesByMeansRatherThanByTheFlowAtTheirEnd) {
  MeshInput input = square_input();
  input.mesh.type = MeshType::metric;
  AdaptOptions options = adapt_options();
  options.source = AdaptOptions::Source::error;
  options.variables = {"error"};
  options.norm = 2;
  options.max_nodes = 400;
  SolvedMesh solved = solved_shock(world(), input);
  const std::vector<double> front = std::exchange(solved.solution.values, {});
  solved.solution.names = {"q", "lone_at_end", "error", "q_at_end"};
  for (const double value : front)
    solved.solution.values.insert(solved.solution.values.end(), {value, value, value * value, -value});
  const AdaptationPlan plan = plan_adaptation(world(), input, options, solved);
  ASSERT_TRUE(std::holds_alternative<MetricDemand>(plan.anisotropy));
  const auto& metric = std::get<MetricDemand>(plan.anisotropy);
  EXPECT_EQ(metric.error, "error");
  EXPECT_EQ(metric.variables, (std::vector<std::string>{"q", "lone_at_end"}));
}

}  // namespace
}  // namespace quadloop::adapt
