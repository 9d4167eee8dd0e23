// The door: what other programs see of the library, in memory and on disk, and how it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <type_traits>

#include "mesher/mesh/check/delaunay_check.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "quadloop/quadloop.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// A square and its case in a folder of the test's own.
class Door : public ::testing::Test {
 protected:
  Door() {
    folder_.write("square.geom", "1\nside\n4\n0 0\n1 0\n1 1\n0 1\n");
    folder_.write("case.toml",
                  "title = \"square\"\n[geometry]\nfile = \"square.geom\"\n"
                  "[spacing]\nmin = 0.02\nmax = 0.1\n[boundary.side]\nbc = \"wall\"\n"
                  "[adapt]\nvariable = \"q\"\ncycles = 2\n");
  }

  std::string case_path() const { return file("case.toml"); }
  std::string file(const std::string& name) const { return folder_.file(name); }

  test::TemporaryFolder folder_;
};

Field front(const Mesh& mesh) {
  Field field{{"q"}, {}, {}};
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
    field.values.push_back(std::tanh(40 * (mesh.point(NodeId{i}).x - 0.4)));
  return field;
}

std::int64_t nodes(const Mesh& mesh) { return world().sum(mesh.owned_nodes); }

static_assert(!std::is_default_constructible_v<RefinementFlags>, "marks come from sense() alone");

TEST_F(Door, MeshesAdaptsAndChecks) {
  const Case square(world(), case_path(), {"adapt.min=0.005"});
  EXPECT_EQ(square.title(), "square");
  EXPECT_EQ(square.cycles(), 2);
  NewMesh made = make_mesh(world(), square);
  EXPECT_TRUE(check(world(), made.solved.mesh).empty());
  EXPECT_EQ(made.solved.solution.width(), 0U);
  made.solved.solution = front(made.solved.mesh);
  const RefinementFlags flags = sense(world(), square, made.solved);
  ASSERT_TRUE(flags.changes_mesh());
  const NewMesh next = remesh(world(), square, flags, made.solved);
  EXPECT_THROW(remesh(world(), square, flags, next.solved), InputError);  // they are for the one before
  EXPECT_GT(nodes(next.solved.mesh), nodes(made.solved.mesh));
  EXPECT_TRUE(check(world(), next.solved.mesh).empty());
  EXPECT_EQ(next.solved.solution.names, made.solved.solution.names);
  ASSERT_EQ(next.transferred.relative_drift.size(), 1U);
  EXPECT_LT(std::abs(next.transferred.relative_drift[0]), 0.05);
}

/// Neither a metric nor targets of nodes refine or coarsen a leaf, but the next mesh differs.
TEST_F(Door, TheLoopGoesOnForAMetricAndForTargets) {
  for (const std::vector<std::string>& settings :
       {std::vector<std::string>{"mesh.type=metric", "adapt.norm=2", "adapt.max_nodes=900",
                                 "adapt.min=0.005"},
        std::vector<std::string>{"smooth.targets=solution", "adapt.min=0.1"}}) {
    const Case square(world(), case_path(), settings);
    NewMesh made = make_mesh(world(), square);
    made.solved.solution = front(made.solved.mesh);
    const RefinementFlags flags = sense(world(), square, made.solved);
    EXPECT_EQ(flags.refined() + flags.coarsened(), 0) << settings.front();
    ASSERT_TRUE(flags.changes_mesh()) << settings.front();
    const NewMesh next = remesh(world(), square, flags, made.solved);
    EXPECT_NE(next.solved.mesh.points, made.solved.mesh.points) << settings.front();
    EXPECT_TRUE(check(world(), next.solved.mesh).empty()) << settings.front();
  }
}

const char* const square_text =
    "[[shape]]\nname = \"side\"\nkind = \"polygon\"\npoints = [[0, 0], [1, 0], [1, 1], [0, 1]]\n"
    "[spacing]\nmin = 0.02\nmax = 0.1\n[boundary.side]\nbc = \"wall\"\n"
    "[adapt]\nvariable = \"q\"\ncycles = 2\nmin = 0.005\n";

TEST_F(Door, ACaseMayBeText) {
  const Case of_text(world(), CaseSource("square", square_text)), of_file(world(), case_path());
  EXPECT_EQ(make_mesh(world(), of_text).solved.mesh.points, make_mesh(world(), of_file).solved.mesh.points);
  try {
    const Case wrong(world(), CaseSource("square", std::string("title = 3\n") + square_text));
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("square: 'title'"), 0U) << error.what();
  }
}

TEST_F(Door, TheLoopHasTheMeshesOfItsSteps) {
  const Case square(world(), CaseSource("square", square_text));
  SolvedMesh step = make_mesh(world(), square).solved;
  Adaptation run(world(), square);
  auto in_folder = std::make_unique<Adaptation>(world(), square, AdaptationOptions{.folder = file("run")});
  EXPECT_EQ(run.solved(), nullptr);
  std::vector<std::shared_ptr<const SolvedMesh>> kept;
  for (int cycle = 0; run.begin_cycle(); ++cycle) {
    ASSERT_TRUE(in_folder->begin_cycle());
    EXPECT_EQ(run.cycle(), cycle);
    EXPECT_EQ(run.solved()->mesh.points, step.mesh.points);
    EXPECT_EQ(in_folder->solved()->mesh.points, step.mesh.points);
    EXPECT_EQ(run.initial_state().values, step.solution.values);
    step.solution = front(step.mesh);
    SolvedFlow flow;
    flow.solution = step.solution;
    const CycleReport report = run.finish_cycle(flow);
    in_folder->finish_cycle(flow);
    EXPECT_EQ(report.cycle, cycle);
    EXPECT_NE(report.record.find("\"nodes\": " + std::to_string(nodes(step.mesh))), std::string::npos);
    kept.push_back(run.solved());
    if (cycle < 2) step = remesh(world(), square, sense(world(), square, step), step).solved;
  }
  EXPECT_EQ(kept.size(), 3U);
  EXPECT_FALSE(in_folder->begin_cycle());
  in_folder.reset();  // which holds the folder
  EXPECT_LT(nodes(kept[0]->mesh), nodes(kept[2]->mesh)) << "meshes live as long as they are held";
  Adaptation again(world(), square, {.folder = file("run"), .resume = true});
  EXPECT_FALSE(again.begin_cycle()) << "all cycles exist";
  EXPECT_EQ(gather_whole(world(), again.solved()->mesh).points, gather_whole(world(), step.mesh).points)
      << "which files distribute in another way";
  EXPECT_THROW(Adaptation(world(), Case(world(), case_path(), {"spacing.max=0.2"}),
                          {.folder = file("run"), .resume = true}),
               InputError);
}

TEST_F(Door, WritesAndReadsTheSameMeshAndField) {
  const Case square(world(), case_path());
  const Mesh mesh = make_mesh(world(), square).solved.mesh;
  for (const char* name : {"a.mesh", "a.vtu"}) {
    write(world(), mesh, file(name), front(mesh));
    const MeshFile back = read(world(), file(name));
    EXPECT_EQ(nodes(back.mesh), nodes(mesh)) << name;
    EXPECT_TRUE(check(world(), back.mesh).empty()) << name;
    ASSERT_EQ(back.field.names, std::vector<std::string>{"q"}) << name;
    EXPECT_EQ(back.field.values, front(back.mesh).values) << name;
  }
}

TEST_F(Door, GoesOnFromWhatWasKept) {
  const Case square(world(), case_path(), {"adapt.min=0.005"});
  SolvedMesh made = make_mesh(world(), square).solved;
  made.solution = front(made.mesh);
  write_solved(world(), made, file("kept"));
  const SolvedMesh kept = read_solved(world(), square, file("kept"));
  const NewMesh next = remesh(world(), square, sense(world(), square, made), made),
                again = remesh(world(), square, sense(world(), square, kept), kept);
  EXPECT_EQ(again.solved.mesh.points, next.solved.mesh.points);
  EXPECT_EQ(again.solved.solution.values, next.solved.solution.values);
  const Case finer(world(), case_path(), {"spacing.max=0.05"});
  EXPECT_THROW(read_solved(world(), finer, file("kept")), InputError);
  EXPECT_THROW(read_solved(world(), square, file("none")), InputError);
}

TEST_F(Door, SaysWhatAFormatHasNoPlaceFor) {
  const Case square(world(), case_path());
  const Mesh mesh = make_mesh(world(), square).solved.mesh;
  EXPECT_TRUE(write(world(), mesh, file("a.cgns"), front(mesh)).empty());
  const std::vector<std::string> losses = write(world(), mesh, file("a.su2"), front(mesh));
  ASSERT_EQ(losses.size(), 2U);
  EXPECT_NE(losses[0].find("solution"), std::string::npos) << losses[0];
  EXPECT_NE(losses[1].find("boundary conditions"), std::string::npos) << losses[1];
}

/// The same on all ranks that have the node; those on the unit square's sides stay.
Point shaken(Point p) {
  const double reach = 2 * p.x * (1 - p.x) * p.y * (1 - p.y);
  return {p.x + reach * std::sin(1000 * p.x + 700 * p.y), p.y + reach * std::cos(900 * p.y - 500 * p.x)};
}

TEST_F(Door, SmoothsAMeshThatWasRead) {
  const Case square(world(), case_path(), {"smooth.sweeps=5", "mesh.quads=\"all\""});
  Mesh mesh = make_mesh(world(), square).solved.mesh;
  for (Point& p : mesh.points) p = shaken(p);
  write(world(), mesh, file("b.mesh"));
  MeshFile back = read(world(), file("b.mesh"));
  const QualitySummary before = summarise_quality(world(), back.mesh);
  smooth(world(), square, back.mesh);
  const QualitySummary after = summarise_quality(world(), back.mesh);
  EXPECT_TRUE(check(world(), back.mesh).empty());
  EXPECT_GT(after.worst, before.worst);
  EXPECT_GT(after.mean, before.mean);
}

TEST_F(Door, SmoothingLeavesADelaunayMeshDelaunay) {
  const std::vector<std::string> graded{"mesh.type=\"delaunay\"", "boundary.side.spacing=0.03"};
  std::vector<std::string> as_cut = graded;
  as_cut.push_back("smooth.sweeps=0");
  Mesh mesh = make_mesh(world(), Case(world(), case_path(), as_cut)).solved.mesh;
  const std::vector<Point> points = mesh.points;
  smooth(world(), Case(world(), case_path(), graded), mesh);
  EXPECT_TRUE(world().any(mesh.points != points));
  const Mesh whole = gather_whole(world(), mesh);
  if (world().is_root()) {
    EXPECT_TRUE(is_delaunay(whole));
  }
}

TEST_F(Door, SolvesWithTheBuiltInSolver) {
  const Case square(world(), case_path(),
                    {"solver.iterations=2", "solver.mach=0.5", "boundary.side.bc=\"farfield\""});
  const Mesh mesh = make_mesh(world(), square).solved.mesh;
  const SolvedFlow flow = built_in_solver(world(), square)(world(), mesh, {}, 0);
  ASSERT_EQ(flow.solution.names,
            (std::vector<std::string>{"density", "x_velocity", "y_velocity", "pressure"}));
  ASSERT_EQ(flow.solution.values.size(), 4 * static_cast<std::size_t>(mesh.owned_nodes));
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {  // nothing disturbs the free stream
    const auto state = flow.solution.row(NodeId{i});
    EXPECT_NEAR(state[0], 1, 1e-9);
    EXPECT_NEAR(std::hypot(state[1], state[2]), 0.5, 1e-9);
    EXPECT_NEAR(state[3], 1 / 1.4, 1e-9);
  }
}

/// An oval as a polygon of 16 points, sheared upwards.
std::vector<Point> oval(double up) {
  std::vector<Point> points;
  for (int i = 0; i < 16; ++i)
    points.emplace_back(std::cos(i * M_PI / 8), 0.6 * std::sin(i * M_PI / 8) + up * std::cos(i * M_PI / 8));
  return points;
}

MorphGeometry body(const std::vector<Point>& points) { return MorphGeometry({{"body", points}}); }

Case flow_around_oval() {
  std::ostringstream points;
  points.precision(17);
  for (const Point& p : oval(0)) points << (points.tellp() > 0 ? ", [" : "[") << p.x << ", " << p.y << "]";
  const std::string text =
      "[[shape]]\nname = \"body\"\nkind = \"polygon\"\npoints = [" + points.str() +
      "]\n[geometry]\nfar_field = 5.0\n[spacing]\nmin = 0.15\nmax = 1.5\n"
      "[boundary.body]\nspacing = 0.3\nbc = \"wall\"\n[boundary.farfield]\nbc = \"farfield\"\n"
      "[solver]\nkind = \"euler\"\nmach = 0.3\nalpha = 2.0\niterations = 300\ntolerance = 1e-11\n"
      "goal = [\"lift\", \"drag\"]\ngoal_adjoint = \"write\"\n";
  return {world(), CaseSource("oval", text)};
}

/// The derivative of a functional by each owned node, from the solution.
std::vector<Point> by_nodes(const Field& solution, const std::string& name) {
  const auto x = std::ranges::find(solution.names, name + "_by_x") - solution.names.begin();
  std::vector<Point> rows;
  for (std::size_t i = x; i < solution.values.size(); i += solution.width())
    rows.push_back({solution.values[i], solution.values[i + 1]});
  return rows;
}

TEST_F(Door, GivesDerivativesOfTheFlowByTheOutline) {
  const Case around = flow_around_oval();
  const FlowSolver solver = built_in_solver(world(), around);
  const Mesh mesh = make_mesh(world(), around).solved.mesh;
  const auto corners = oval(0);
  const auto moved_flow = [&](double up, const Field& start) {
    return solver(world(), *Morph(world(), mesh, body(corners), body(oval(up))).mesh(), start, -1);
  };
  const SolvedFlow flow = moved_flow(0, {});
  EXPECT_GT(flow.steps.value_or(0), 5);
  EXPECT_TRUE(flow.warnings.empty()) << flow.warnings.front();
  const double step = 2e-6;
  const SolvedFlow above = moved_flow(step, flow.solution), below = moved_flow(-step, flow.solution);
  const Morph morph(world(), mesh, body(corners), body(corners));
  ASSERT_EQ(flow.goals.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    const GoalValue& goal = flow.goals[k];
    EXPECT_NEAR(goal.value, k == 0 ? *flow.cl : *flow.cd, 1e-12);
    const std::vector<Point> by_points = morph.pull_back(by_nodes(flow.solution, goal.name)).front();
    double slope = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) slope += by_points[i].y * corners[i].x;
    const double difference = (above.goals[k].value - below.goals[k].value) / (2 * step);
    EXPECT_GT(std::abs(difference), 1e-3);
    EXPECT_NEAR(slope, difference, 2e-5 * std::abs(difference)) << goal.name;
  }
}

TEST_F(Door, NamesWhatIsWrongWithAMesh) {
  Mesh mesh = make_mesh(world(), Case(world(), case_path())).solved.mesh;
  if (world().is_root()) mesh.points.front() = {5, 5};
  const std::vector<std::string> faults = check(world(), mesh);
  ASSERT_FALSE(faults.empty());
  EXPECT_NE(faults.front().find(" at ("), std::string::npos) << faults.front();
}

TEST_F(Door, RefusesOnAllRanks) {
  EXPECT_THROW(Case(world(), file("none.toml")), InputError);
  EXPECT_THROW(Case(world(), case_path(), {"spacing.mni=1"}), InputError);
  EXPECT_THROW(read(world(), file("none.mesh")), InputError);
  const Case square(world(), case_path());
  SolvedMesh solved = make_mesh(world(), square).solved;
  EXPECT_THROW(sense(world(), square, solved), InputError);  // no such variable
  EXPECT_THROW(write(world(), solved.mesh, file("none/a.mesh")), OutputError);
  EXPECT_THROW(write(world(), solved.mesh, file("a.xyz")), InputError);
  EXPECT_THROW(write(world(), solved.mesh, file("a.csv"), front(solved.mesh)), InputError);
  solved.solution = front(solved.mesh);
  if (world().is_root()) solved.solution.values.pop_back();
  EXPECT_THROW(sense(world(), square, solved), InputError);
  EXPECT_THROW(write(world(), solved.mesh, file("a.mesh"), solved.solution), InputError);
  const Case by_command(world(), case_path(), {"solver.kind=\"command\"", "solver.command=[\"true\"]"});
  EXPECT_THROW(built_in_solver(world(), by_command), InputError);
}

}  // namespace
}  // namespace quadloop
