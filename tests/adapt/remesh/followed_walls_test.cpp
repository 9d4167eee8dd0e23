// Friction on the walls of a mesh with layers, and first heights that follow it into the next mesh.
#include "adapt/remesh/followed_walls.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <sstream>

#include "adapt/remesh/own_mesh.hpp"
#include "adapt/remesh/remesh.hpp"
#include "flow/postprocess/wall_table.hpp"
#include "generate/leaf_quadrant.hpp"
#include "generate/mesh_trial.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

constexpr double viscosity = 0.01, density = 4;

/// A channel from x = 0 to 4, y = 0 to 2, whose floor wants y+ = 2, with an estimate of 0.01.
MeshInput channel() {
  Boundary floor{"floor", 0.2, 30, "wall"}, rest{"rest", 0.2, 30, "none"};
  floor.layers = LayerSpec{0.01, 1.5, 1.5, 5, 1, 2};
  const std::vector<BoundaryId> of_segment{BoundaryId{0}, BoundaryId{1}, BoundaryId{1}, BoundaryId{1}};
  MeshInput input{{{floor, rest}, {{0, 0}, {4, 0}, {4, 2}, {0, 2}}, {0, 4}, of_segment}, {}, {}, 0};
  input.mesh.size.min = 0.005;
  input.mesh.size.max = 0.25;
  return input;
}

AdaptOptions options() {
  AdaptOptions options;
  options.variables = {"density"};
  options.wall_flow = WallFlow{viscosity, 1};
  return options;
}

/// Wall units that the flow has along the floor, by half as many again from its beginning to its end.
double wall_units(double x) { return 150 + 18.75 * x; }

SolvedMesh solved(const Communicator& comm, const MeshInput& input, const std::string& name,
                  double (*value)(double x)) {
  MeshResult made = generate_mesh(comm, input).result;
  SolvedMesh solved{std::move(made.mesh), std::move(made.tree), {{"density", name}, {}, {}}, "flow.mesh"};
  for (std::int32_t i = 0; i < solved.mesh.owned_nodes; ++i) {
    const Point p = solved.mesh.point(NodeId{i});
    solved.solution.values.push_back(density);
    solved.solution.values.push_back(p.y == 0 ? value(p.x) : 0);
  }
  return solved;
}

double shear(double x) {
  const double u_tau = wall_units(x) * viscosity / density;  // u_tau / nu
  return -density * u_tau * u_tau;
}

double y_plus(double x) { return 0.01 * wall_units(x); }

void expect_friction_of_the_floor(const MeasuredWall& wall) {
  ASSERT_GT(wall.size(), 10U);
  double reached = 0;
  for (const MeasuredEdge& edge : wall) {
    EXPECT_EQ(edge.from.y, 0);
    EXPECT_LT(edge.from.x, edge.to.x) << "the domain to its left";
    EXPECT_NEAR(edge.wall_units_from, wall_units(edge.from.x), 1e-6);
    EXPECT_NEAR(edge.wall_units_to, wall_units(edge.to.x), 1e-6);
    reached += edge.to.x - edge.from.x;
  }
  EXPECT_NEAR(reached, 4, 1e-12);
}

TEST(FollowedWalls, TellFrictionByWallShear) {
  const MeshInput input = channel();
  expect_friction_of_the_floor(
      wall_to_follow(world(), input, options(), solved(world(), input, "wall_shear", shear)));
}

TEST(FollowedWalls, TellFrictionByYPlusOfTheFirstNodes) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshInput input = channel();
    input.mesh.type = type;
    for (const char* name : {"y_plus", "Y_Plus", "yPlus", "y+"})
      expect_friction_of_the_floor(
          wall_to_follow(world(), input, options(), solved(world(), input, name, y_plus)));
  }
}

/// SU2's y+ is wrong at the roots of wakes, its friction coefficient is not.
TEST(FollowedWalls, PreferAFrictionCoefficientToYPlus) {
  const MeshInput input = channel();
  constexpr double dynamic_pressure = 3;
  SolvedMesh flow = solved(world(), input, "Skin_Friction_Coefficient_x",
                           [](double x) { return 0.6 * shear(x) / dynamic_pressure; });
  std::vector<double> values;
  for (std::int32_t i = 0; i < flow.mesh.owned_nodes; ++i) {
    const auto row = flow.solution.row(NodeId{i});
    values.insert(values.end(), {row[0], row[1], row[1] * 0.8 / 0.6, 1000.0});
  }
  flow.solution = {
      {"density", "Skin_Friction_Coefficient_x", "Skin_Friction_Coefficient_y", "Y_Plus"}, values, {}};
  AdaptOptions with_pressure = options();
  with_pressure.wall_flow->dynamic_pressure = dynamic_pressure;
  expect_friction_of_the_floor(wall_to_follow(world(), input, with_pressure, flow));
}

TEST(FollowedWalls, UseYPlusWithoutTheDynamicPressureOfACoefficient) {
  const MeshInput input = channel();
  SolvedMesh flow = solved(world(), input, "y_plus", y_plus);
  std::vector<double> values;
  for (std::int32_t i = 0; i < flow.mesh.owned_nodes; ++i) {
    const auto row = flow.solution.row(NodeId{i});
    values.insert(values.end(), {row[0], row[1], 0.001, 0.001});
  }
  flow.solution = {
      {"density", "y_plus", "Skin_Friction_Coefficient_x", "Skin_Friction_Coefficient_y"}, values, {}};
  expect_friction_of_the_floor(wall_to_follow(world(), input, options(), flow));
}

/// Of the cells at a wall node the thinnest one counts: triangles have the height of a node beside it.
TEST(FollowedWalls, TakeTheSmallestHeightAtANode) {
  MeshInput input = channel();
  input.mesh.type = MeshType::delaunay;
  for (const double slope : {0.1, -0.1}) {
    const auto first_height = [&](double x) { return 0.01 * (1 + slope * (x - 2)); };
    SolvedMesh flow = solved(world(), input, "y_plus", y_plus);
    for (Point& p : flow.mesh.points) {
      if (std::abs(p.y - 0.01) < 1e-6) p.y = first_height(p.x);
    }
    for (std::int32_t i = 0; i < flow.mesh.owned_nodes; ++i) {
      const Point p = flow.mesh.point(NodeId{i});
      if (p.y == 0) flow.solution.row(NodeId{i})[1] = first_height(p.x) * wall_units(p.x);
    }
    for (const MeasuredEdge& edge : wall_to_follow(world(), input, options(), flow)) {
      EXPECT_GE(edge.wall_units_from, wall_units(edge.from.x) - 1e-6) << edge.from.x;
      EXPECT_GE(edge.wall_units_to, wall_units(edge.to.x) - 1e-6) << edge.to.x;
    }
  }
}

/// The flow of a solver that keeps its values in cells, 0 where they touch no wall, as OpenFOAM's function
/// objects do; of an edge at the floor by the place of its middle.
SolvedMesh solved_in_cells(const MeshInput& input, const std::vector<std::string>& names,
                           const std::function<std::vector<double>(double x, double height)>& values) {
  MeshResult made = generate_mesh(world(), input).result;
  SolvedMesh solved{std::move(made.mesh), std::move(made.tree), {}, "flow.mesh"};
  CellValues& cells = solved.solution.cells;
  cells.names = names;
  const std::vector<CellShape> shapes = cell_shapes(solved.mesh);
  std::size_t number = 0;
  const auto add = [&](const auto& cell) {
    double sum = 0;
    int feet = 0;
    for (const NodeId node : cell) {
      if (solved.mesh.point(node).y != 0) continue;
      sum += solved.mesh.point(node).x;
      ++feet;
    }
    std::vector<double> row(names.size(), 0);
    if (feet == 2) row = values(sum / 2, shapes[number].centroid.y);
    cells.values.insert(cells.values.end(), row.begin(), row.end());
    ++number;
  };
  for (const auto& cell : solved.mesh.triangles) add(cell);
  for (const auto& cell : solved.mesh.quads) add(cell);
  return solved;
}

/// Linear inside; at its ends the mean of one edge alone, half a cell away.
void expect_friction_of_cells(const MeasuredWall& wall) {
  ASSERT_GT(wall.size(), 10U);
  for (const MeasuredEdge& edge : wall) {
    const double allowed = edge.from.x == 0 || edge.to.x == 4 ? 0.03 * wall_units(4) : 1;
    EXPECT_NEAR(edge.wall_units_from, wall_units(edge.from.x), allowed);
    EXPECT_NEAR(edge.wall_units_to, wall_units(edge.to.x), allowed);
  }
}

TEST(FollowedWalls, TellFrictionByTheCellsAtThem) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshInput input = channel();
    input.mesh.type = type;
    const SolvedMesh by_height =
        solved_in_cells(input, {"U_x", "yPlus"}, [](double x, double height) -> std::vector<double> {
          return {1, height * wall_units(x)};
        });
    expect_friction_of_cells(wall_to_follow(world(), input, options(), by_height));
    const SolvedMesh by_shear = solved_in_cells(input, {"rho", "wallShearStress_x", "wallShearStress_y"},
                                                [](double x, double) -> std::vector<double> {
                                                  return {density, 0.6 * shear(x), 0.8 * shear(x)};
                                                });
    expect_friction_of_cells(wall_to_follow(world(), input, options(), by_shear));
  }
  const SolvedMesh bad = solved_in_cells(channel(), {"yPlus"}, [](double x, double) -> std::vector<double> {
    return {x > 3 ? std::nan("") : 1};
  });
  try {
    wall_to_follow(world(), channel(), options(), bad);
    FAIL();
  } catch (const InputError& fault) {
    EXPECT_TRUE(std::string(fault.what()).starts_with("flow.mesh: 'yPlus' is not finite in the cell"))
        << fault.what();
  }
}

TEST(FollowedWalls, KeepWhatTheTreeHasWhereNothingIsTold) {
  const MeshInput input = channel();
  SolvedMesh silent = solved(world(), input, "temperature", y_plus);
  EXPECT_TRUE(wall_to_follow(world(), input, options(), silent).empty());
  silent.tree.measured.walls = {{{0, 0}, {4, 0}, 7, 8}};
  EXPECT_EQ(wall_to_follow(world(), input, options(), silent), silent.tree.measured.walls);
  AdaptOptions without = options();
  without.wall_flow.reset();
  EXPECT_TRUE(wall_to_follow(world(), input, without, silent).empty());
}

TEST(FollowedWalls, RefuseWhatIsNotFinite) {
  const MeshInput input = channel();
  const SolvedMesh bad =
      solved(world(), input, "wall_shear", [](double x) { return x > 3 ? std::nan("") : 1; });
  try {
    wall_to_follow(world(), input, options(), bad);
    FAIL();
  } catch (const InputError& fault) {
    EXPECT_TRUE(std::string(fault.what()).starts_with("flow.mesh: 'wall_shear' is not finite"))
        << fault.what();
  }
}

/// The first node above each wall node, by its height.
void expect_heights(const Mesh& mesh) {
  for (const auto& cell : mesh.quads) {
    for (std::size_t k = 0; k < 4; ++k) {
      const Point foot = mesh.point(cell[k]), above = mesh.point(cell[(k + 3) % 4]);
      if (foot.y != 0 || mesh.point(cell[(k + 1) % 4]).y != 0) continue;
      EXPECT_NEAR(above.y * wall_units(foot.x), 2, 1e-3) << foot.x;
    }
  }
}

TEST(FollowedWalls, TheNextMeshHasTheYPlusThatIsWantedAndSoHasItsRestart) {
  const MeshInput input = channel();
  const SolvedMesh flow = solved(world(), input, "wall_shear", shear);
  const AdaptationPlan plan = plan_adaptation(world(), input, options(), flow);
  EXPECT_EQ(plan.refined + plan.coarsened, 0) << "density is constant";
  EXPECT_TRUE(plan.new_layers);
  EXPECT_TRUE(plan.changes_mesh());
  EXPECT_TRUE(plan.warnings.empty());
  const RemeshedSolution remeshed = remesh_and_transfer(world(), input, plan, flow);
  const MeshResult& made = remeshed.generated.result;
  expect_heights(made.mesh);
  EXPECT_EQ(made.tree.measured, plan.measured);
  ASSERT_EQ(remeshed.generated.layers.size(), 1U);
  EXPECT_NEAR(remeshed.generated.layers[0].first_asked, 2 / wall_units(4), 1e-6);
  EXPECT_NEAR(remeshed.generated.layers[0].first_asked_most, 2 / wall_units(0), 1e-6);
  const AdaptationPlan standing = unchanged_plan(made.tree, input);
  const MeshResult again =
      generate_mesh(world(), input, DemandedSplits(world(), standing.demands), standing.measured).result;
  EXPECT_EQ(again.tree.attributes.coordinate_digest, made.tree.attributes.coordinate_digest);
  const Communicator alone(MPI_COMM_SELF);
  const SolvedMesh of_one = solved(alone, input, "wall_shear", shear);
  const AdaptationPlan plan_of_one = plan_adaptation(alone, input, options(), of_one);
  EXPECT_EQ(plan_of_one.measured, plan.measured);
  EXPECT_EQ(remesh_and_transfer(alone, input, plan_of_one, of_one)
                .generated.result.tree.attributes.coordinate_digest,
            made.tree.attributes.coordinate_digest);
}

TEST(FollowedWalls, HeightsThatStayChangeNoMesh) {
  const MeshInput input = channel();
  SolvedMesh flow = solved(world(), input, "wall_shear", shear);
  flow.tree.measured.walls = wall_to_follow(world(), input, options(), flow);
  EXPECT_FALSE(other_heights(input, flow.tree.measured, flow.tree.measured));
  for (MeasuredEdge& edge : flow.tree.measured.walls) edge.wall_units_from *= 1.02;
  EXPECT_FALSE(plan_adaptation(world(), input, options(), flow).new_layers);
  for (MeasuredEdge& edge : flow.tree.measured.walls) edge.wall_units_from *= 1.2;
  EXPECT_TRUE(plan_adaptation(world(), input, options(), flow).new_layers);
}

TEST(PlanWithLayers, TheCapCountsTheirNodes) {
  const MeshInput input = channel();
  SolvedMesh flow = solved(world(), input, "other", y_plus);
  for (std::int32_t i = 0; i < flow.mesh.owned_nodes; ++i)
    flow.solution.row(NodeId{i})[0] = std::tanh(8 * (flow.mesh.point(NodeId{i}).x - 2));
  AdaptOptions bounded = options();
  const auto nodes = [&](const AdaptOptions& by) {
    const AdaptationPlan plan = plan_adaptation(world(), input, by, flow);
    return generate_mesh(world(), input, DemandedSplits(world(), plan.demands)).result.tree.attributes.nodes;
  };
  bounded.min = 0.01;
  const std::int64_t before = flow.tree.attributes.nodes, all = nodes(bounded);
  bounded.max_nodes = before + (all - before) / 2;
  const std::int64_t made = nodes(bounded);
  EXPECT_LE(made, *bounded.max_nodes);
  EXPECT_GT(made, before);
  bounded.threshold = AdaptOptions::Threshold::nodes;
  const std::int64_t filled = nodes(bounded);
  EXPECT_LE(filled, *bounded.max_nodes);
  EXPECT_GE(static_cast<double>(filled), 0.95 * static_cast<double>(*bounded.max_nodes));
}

TEST(OwnMesh, MayHaveLayersThatReachFarBelowTheirLeaves) {
  MeshInput input = channel();
  Boundary floor = input.geometry.boundaries()[0], rest = input.geometry.boundaries()[1];
  floor.layers = LayerSpec{0.01, 1.3, 1.3, 12};  // 0.74 thick
  const std::vector<BoundaryId> of_segment{BoundaryId{0}, BoundaryId{1}, BoundaryId{1}, BoundaryId{1}};
  input.geometry = {{floor, rest}, {{0, 0}, {4, 0}, {4, 2}, {0, 2}}, {0, 4}, of_segment};
  SolvedMesh flow = solved(world(), input, "other", y_plus);
  EXPECT_NO_THROW(require_untouched_mesh(world(), flow, "mesh", "tree"));
  for (Point& p : flow.mesh.points) p.x += 1e-9;
  EXPECT_NO_THROW(require_own_mesh(world(), flow, "mesh", "tree")) << "other formats round";
  EXPECT_THROW(require_untouched_mesh(world(), flow, "mesh", "tree"), InputError);
  for (Point& p : flow.mesh.points) p.x += 1;
  EXPECT_THROW(require_own_mesh(world(), flow, "mesh", "tree"), InputError);
}

/// A wedge of layers with sharp edges, in a box; with a wake behind one of them, or fans at both. The edge
/// with the wake has a base of this height.
MeshInput wedge(bool with_wake, double y_plus = 0, double base = 0) {
  Boundary box{"box", 1, 30, "farfield"}, body{"body", 0.25, 30, "wall"};
  body.layers = LayerSpec{0.02, 1.3, 1.3, 8, 1, y_plus};
  std::vector<Point> points{{-8, -8}, {8, -8}, {8, 8}, {-8, 8}, {-2, 0}, {-1.5, 0.5}, {2, base / 2}};
  if (base > 0) points.push_back({2, -base / 2});
  points.push_back({-1.5, -0.5});
  std::vector<BoundaryId> of_segment(4, BoundaryId{0});
  of_segment.resize(points.size(), BoundaryId{1});
  MeshInput input{{{box, body}, points, {0, 4, size32(points)}, of_segment}, {}, {}, 0};
  input.mesh.size.min = 0.02;
  input.mesh.size.max = 1;
  if (with_wake) input.lines = {{{"body"}, {}, 3, 0.1, {}}};
  return input;
}

TEST(FollowedWalls, IgnoreYPlusWhereTheWallTurns) {
  for (const bool with_wake : {false, true}) {
    const MeshInput input = wedge(with_wake, 1);
    MeshResult made = generate_mesh(world(), input).result;
    SolvedMesh flow{std::move(made.mesh), std::move(made.tree), {{"density", "Y_Plus"}, {}, {}}, "flow.mesh"};
    const auto is_edge = [](Point p) {
      return p == Point{2, 0} || p == Point{-2, 0} || std::abs(p.x + 1.5) < 1e-12;
    };
    for (std::int32_t i = 0; i < flow.mesh.owned_nodes; ++i)
      flow.solution.values.insert(flow.solution.values.end(),
                                  {density, is_edge(flow.mesh.point(NodeId{i})) ? 1719.0 : 2.0});
    const MeasuredWall wall = wall_to_follow(world(), input, options(), flow);
    ASSERT_GT(wall.size(), 10U);
    double least = 1e9, most = 0;
    for (const MeasuredEdge& edge : wall) {
      for (const double units : {edge.wall_units_from, edge.wall_units_to}) {
        least = std::min(least, units);
        most = std::max(most, units);
      }
    }
    EXPECT_GT(least, 0);
    EXPECT_LT(most, 2 * least) << "y+ over the heights of the layers";
  }
}

/// At a sharp edge, and at a base of two cells.
TEST(FollowedWalls, IgnoreFrictionAndYPlusAtTheRootOfAWake) {
  for (const bool sheared : {false, true}) {
    for (const double base : {0.0, 0.01}) {
      const MeshInput input = wedge(true, 1, base);
      MeshResult made = generate_mesh(world(), input).result;
      const char* const name = sheared ? "wall_shear" : "Y_Plus";
      SolvedMesh flow{std::move(made.mesh), std::move(made.tree), {{"density", name}, {}, {}}, "flow.mesh"};
      for (std::int32_t i = 0; i < flow.mesh.owned_nodes; ++i) {
        const Point p = flow.mesh.point(NodeId{i});
        const bool at_root = p == Point{2, base / 2} || p == Point{2, -base / 2};
        const bool at_corner = p == Point{-2, 0} || std::abs(p.x + 1.5) < 1e-12;
        const bool wrong = at_root || (at_corner && !sheared);
        flow.solution.values.insert(flow.solution.values.end(), {density, wrong ? 1e6 : 2.0});
      }
      const double units = sheared ? std::sqrt(2.0 * density) / viscosity : 2 / 0.02;
      double most = 0;
      for (const MeasuredEdge& edge : wall_to_follow(world(), input, options(), flow))
        most = std::max({most, edge.wall_units_from, edge.wall_units_to});
      EXPECT_NEAR(most, units, 0.1 * units) << name << ", base " << base;
    }
  }
}

/// The y+ in the last column of the rows at x = 2.
std::vector<double> y_plus_at_edge(const std::string& table) {
  std::vector<double> found;
  std::istringstream in(table);
  for (std::string line; std::getline(in, line);) {
    std::vector<std::string> words;
    std::istringstream row(line);
    for (std::string word; std::getline(row, word, ',');) words.push_back(word);
    if (words.at(2) == "2") found.push_back(std::stod(words.at(7)));
  }
  return found;
}

TEST(FollowedWalls, HaveTheFirstHeightInTheirTableAtTheRootOfAWake) {
  for (const double base : {0.0, 0.2}) {
    const Mesh mesh = generate_mesh(world(), wedge(true, 0, base)).result.mesh;
    Field flow{{"density", "x_velocity", "y_velocity", "pressure", "wall_shear"}, {}, {}};
    for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
      flow.values.insert(flow.values.end(), {1, 1, 0, 1, 1});
    const flow::FreeStream stream{1, 1, 1, 0, 1.4, 0.01, 1};
    const std::vector<double> at_edge =
        y_plus_at_edge(flow::wall_table(world(), mesh, flow, stream, {"body"}));
    if (!world().is_root()) continue;
    EXPECT_GE(at_edge.size(), 2U);
    for (const double y_plus : at_edge) EXPECT_NEAR(y_plus, 0.02 / 0.01, 0.2) << "base " << base;
  }
}

/// Splits, by two levels, of the leaves above a wake between x = 3 and 3.5, as adaptation requests them.
DemandedSplits splits_beside_wake(const MeshInput& input) {
  const MeshResult made = generate_mesh(world(), input).result;
  const TreeGrid grid = input.grid();
  std::vector<SplitDemand> demands;
  for (const LeafRecord& leaf : made.tree.leaves) {
    const Quadrant q = quadrant_of(leaf);
    const Point centre = grid.box_of(q).centre();
    if (centre.x < 3 || centre.x > 3.5 || centre.y < 0.5 || centre.y > 1) continue;
    const std::uint32_t child_levels = 3U << q.level;
    for (const Corner quarter : corners_along_curve) demands.push_back({q.child(quarter), child_levels});
  }
  return {world(), demands};
}

TEST(PlanWithLayers, TheColumnsOfAWakeAreRefinedWithTheCellsBesideThem) {
  const MeshInput input = wedge(true);
  const DemandedSplits splits = splits_beside_wake(input);
  const MeshResult before = generate_mesh(world(), input).result,
                   made = generate_mesh(world(), input, splits).result;
  const auto columns = [](const MeshResult& result) { return result.mesh.strips.at(0).columns(); };
  EXPECT_GT(columns(made), columns(before) + 10);
  const auto smallest_angle = [](const MeshResult& result) {
    return summarise_quality(world(), result.mesh).smallest_degrees;
  };
  EXPECT_GT(smallest_angle(made), 0.7 * smallest_angle(before));
  const NodeBounds counted = MeshTrial(world(), input).nodes(splits);
  EXPECT_GE(counted.most, made.tree.attributes.nodes);
  EXPECT_LE(counted.least, made.tree.attributes.nodes);
}

TEST(MeshTrial, CountsTheNodesOfLayersAndWakes) {
  const MeshInput straight = channel();
  const NodeBounds exact = MeshTrial(world(), straight).nodes({});
  EXPECT_EQ(exact.least, exact.most) << "there are no fans";
  EXPECT_EQ(exact.most, generate_mesh(world(), straight).result.tree.attributes.nodes);
  for (const bool with_wake : {false, true}) {
    const MeshInput input = wedge(with_wake);
    const std::int64_t made = generate_mesh(world(), input).result.tree.attributes.nodes;
    const NodeBounds counted = MeshTrial(world(), input).nodes({});
    EXPECT_GE(counted.most, made) << with_wake;
    EXPECT_LE(counted.least, made) << with_wake;
    EXPECT_LE(static_cast<double>(counted.most), 1.1 * static_cast<double>(counted.least)) << with_wake;
    if (with_wake) {
      EXPECT_LE(counted.most, counted.least + 2) << "a wake has no fan";
    }
  }
}

}  // namespace
}  // namespace quadloop::adapt
