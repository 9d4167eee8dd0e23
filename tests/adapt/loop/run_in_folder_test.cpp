// Whole runs in a folder: which files they leave, and that a run gone on with ends with the same ones.
#include "adapt/loop/run_in_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "adapt/loop/cycle_files.hpp"
#include "io/mesh_file.hpp"
#include "io/tree/tree_file.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder, test::world;

/// A vortex in a square, a few steps of it.
AdaptiveCase vortex_case(int cycles) {
  flow::EulerOptions euler;
  euler.mach = 0.5;
  euler.initial = flow::EulerOptions::Initial::vortex;
  euler.reference_length = 0.1;
  euler.iterations = 3;
  AdaptiveCase adaptive{{{{{"far", 0, 30, "farfield"}},
                          {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                          {0, 4},
                          std::vector<BoundaryId>(4, BoundaryId{0})},
                         {},
                         {},
                         0},
                        {},
                        euler,
                        {"vtu", "mesh"},
                        {{"solver.iterations", "3"}}};
  adaptive.mesh.mesh.size.min = adaptive.mesh.mesh.size.max = 0.125;
  adaptive.adapt.cycles = cycles;
  adaptive.adapt.min = 1.0 / 64;
  return adaptive;
}

struct Heard {
  LoopEnd run(const AdaptiveCase& adaptive, const std::string& folder, bool resume) {
    return run_in_folder(
        world(), adaptive, folder, resume,
        {[&](const CycleRecord& record, const std::vector<std::string>&) { cycles.push_back(record.cycle); },
         [&](const std::string& warning) { warnings.push_back(warning); }});
  }
  std::vector<int> cycles;
  std::vector<std::string> warnings;
};

TEST(RunInFolder, EachCycleHasItsFiles) {
  const TemporaryFolder folder;
  Heard heard;
  const LoopEnd end = heard.run(vortex_case(1), folder.file("run"), false);
  EXPECT_EQ(end.last, 1);
  EXPECT_EQ(heard.cycles, (std::vector<int>{0, 1}));
  world().barrier();
  EXPECT_EQ(test::files_in(folder.file("run")), 2U) << "two cycles and no lock";
  for (const char* cycle : {"run/cycle_00", "run/cycle_01"}) {
    for (const char* name : {"mesh.mesh", "mesh.tree.h5", "mesh.cgns", "mesh.vtu", "mesh.walls.csv",
                             "mesh.history.csv", "log.txt", "record.json"})
      EXPECT_TRUE(fs::exists(folder.file(cycle) + "/" + name)) << cycle << " " << name;
    EXPECT_EQ(test::files_in(folder.file(cycle)), 8U);
    EXPECT_TRUE(io::read_mesh(folder.file(cycle) + "/mesh.mesh").solution.has_value());
  }
  const std::string log = test::bytes_of(folder.file("run/cycle_01/log.txt"));
  EXPECT_TRUE(log.starts_with("cycle 1: "));
  EXPECT_NE(log.find("\nnext cycle: "), std::string::npos);
  world().barrier();
}

TEST(RunInFolder, GoneOnWithItEndsWithTheSameFiles) {
  const TemporaryFolder folder;
  Heard whole, begun, resumed;
  whole.run(vortex_case(2), folder.file("whole"), false);
  begun.run(vortex_case(1), folder.file("parts"), false);
  AdaptiveCase more = vortex_case(2);
  resumed.run(more, folder.file("parts"), true);
  EXPECT_EQ(resumed.cycles, (std::vector<int>{2}));
  world().barrier();
  for (const char* name : {"mesh.mesh", "mesh.tree.h5", "mesh.vtu", "mesh.walls.csv", "mesh.history.csv"})
    EXPECT_TRUE(test::bytes_of(folder.file("whole/cycle_02/") + name) ==
                test::bytes_of(folder.file("parts/cycle_02/") + name))
        << name;
  world().barrier();
}

TEST(RunInFolder, WithWantedSizesIsGoneOnWithToTheSameFilesAndEndsWhereItHasSettled) {
  const auto sized = [](int cycles, double until) {
    AdaptiveCase adaptive = vortex_case(cycles);
    adaptive.adapt.norm = 2;
    adaptive.adapt.max_nodes = 400;
    if (until > 0) adaptive.adapt.until.estimate = until;
    return adaptive;
  };
  const TemporaryFolder folder;
  Heard whole, begun, resumed, settled, again;
  const LoopEnd end = whole.run(sized(2, 0), folder.file("whole"), false);
  EXPECT_FALSE(end.settled);
  begun.run(sized(1, 0), folder.file("parts"), false);
  resumed.run(sized(2, 0), folder.file("parts"), true);
  EXPECT_EQ(resumed.cycles, (std::vector<int>{2}));
  world().barrier();
  for (const char* name : {"mesh.mesh", "mesh.tree.h5", "mesh.estimate.vtu"})
    EXPECT_TRUE(test::bytes_of(folder.file("whole/cycle_02/") + name) ==
                test::bytes_of(folder.file("parts/cycle_02/") + name))
        << name;
  // A change of under 1000 times the estimate: after the second cycle. Resumed it stays so.
  EXPECT_TRUE(settled.run(sized(5, 1000), folder.file("settled"), false).settled);
  EXPECT_EQ(settled.cycles, (std::vector<int>{0, 1}));
  EXPECT_TRUE(again.run(sized(5, 1000), folder.file("settled"), true).settled);
  EXPECT_TRUE(again.cycles.empty());
  const std::string record = test::bytes_of(folder.file("settled/cycle_01/record.json"));
  EXPECT_NE(record.find("\"settled\": true"), std::string::npos) << record;
  EXPECT_NE(record.find("\"estimate\": "), std::string::npos) << record;
  world().barrier();
}

TEST(RunInFolder, WithPassesBeginsWithAnAdaptedMeshAndIsGoneOnWithToTheSameFiles) {
  const auto passing = [](int cycles) {
    AdaptiveCase adaptive = vortex_case(cycles);
    adaptive.adapt.passes = 1;
    return adaptive;
  };
  const TemporaryFolder folder;
  Heard whole, begun, resumed;
  whole.run(passing(1), folder.file("whole"), false);
  begun.run(passing(0), folder.file("parts"), false);
  resumed.run(passing(1), folder.file("parts"), true);
  EXPECT_EQ(resumed.cycles, (std::vector<int>{1}));
  world().barrier();
  for (const char* name : {"mesh.mesh", "mesh.tree.h5", "mesh.walls.csv"})
    EXPECT_TRUE(test::bytes_of(folder.file("whole/cycle_01/") + name) ==
                test::bytes_of(folder.file("parts/cycle_01/") + name))
        << name;
  const std::string record = test::bytes_of(folder.file("whole/cycle_00/record.json"));
  EXPECT_NE(record.find("\"passes\": [{\"nodes\": 81, "), std::string::npos) << record;
  EXPECT_EQ(record.find("\n  \"nodes\": 81,"), std::string::npos)
      << "the first cycle's mesh is the case's: " << record;
  world().barrier();
}

/// Laminar flow along the floor of a channel, a few steps of it: too few to be right, enough to have
/// friction.
AdaptiveCase floor_case(int cycles, bool follows_flow = false) {
  Boundary floor{"floor", 0.25, 30, "wall"}, rest{"rest", 0.25, 30, "farfield"};
  floor.layers = LayerSpec{0.01, 1.5, 1.5, 5, 1, 0.5, follows_flow};
  flow::EulerOptions euler;
  euler.mach = 0.5;
  euler.viscosity = 1e-3;
  euler.iterations = 3;
  const std::vector<BoundaryId> of_segment{BoundaryId{0}, BoundaryId{1}, BoundaryId{1}, BoundaryId{1}};
  AdaptiveCase adaptive{{{{floor, rest}, {{0, 0}, {4, 0}, {4, 2}, {0, 2}}, {0, 4}, of_segment}, {}, {}, 0},
                        {},
                        euler,
                        {"mesh"},
                        {}};
  adaptive.mesh.mesh.size.min = 0.02;
  adaptive.mesh.mesh.size.max = 0.25;
  adaptive.adapt.cycles = cycles;
  adaptive.adapt.wall_flow = WallFlow{1e-3, 1};
  return adaptive;
}

TEST(RunInFolder, FirstHeightsFollowTheFlowAndItsTreeKeepsThem) {
  const TemporaryFolder folder;
  Heard whole, begun, resumed;
  whole.run(floor_case(2), folder.file("whole"), false);
  begun.run(floor_case(1), folder.file("parts"), false);
  resumed.run(floor_case(2), folder.file("parts"), true);
  EXPECT_EQ(resumed.cycles, (std::vector<int>{2}));
  world().barrier();
  const auto tree = [&](const std::string& cycle) {
    return io::read_tree(world(), folder.file("whole/" + cycle + "/mesh.tree.h5"));
  };
  EXPECT_TRUE(tree("cycle_00").measured.empty());
  EXPECT_FALSE(tree("cycle_01").measured.empty());
  EXPECT_NE(tree("cycle_02").measured, tree("cycle_01").measured);
  for (const char* name : {"mesh.mesh", "mesh.tree.h5"})
    EXPECT_TRUE(test::bytes_of(folder.file("whole/cycle_02/") + name) ==
                test::bytes_of(folder.file("parts/cycle_02/") + name))
        << name;
  const std::string log = test::bytes_of(folder.file("whole/cycle_02/log.txt")),
                    record = test::bytes_of(folder.file("whole/cycle_02/record.json"));
  EXPECT_NE(log.find("target first heights on floor: 0.0"), std::string::npos) << log;
  EXPECT_NE(record.find("\"first_heights\": {\"floor\": [0.0"), std::string::npos) << record;
  world().barrier();
}

/// Inviscid flow at 6 degrees past a body with a sharp trailing edge, whose wake follows it; a few steps.
AdaptiveCase wake_case(int cycles, bool with_layers) {
  Boundary far{"far", 1, 30, "farfield"}, body{"body", 0.2, 30, "wall"};
  if (with_layers) body.layers = LayerSpec{0.02, 1.2, 1.2, 4, 1};
  flow::EulerOptions euler;
  euler.mach = 0.5;
  euler.alpha = 6;
  euler.iterations = 20;
  std::vector<BoundaryId> of_segment(4, BoundaryId{0});
  of_segment.insert(of_segment.end(), 3, BoundaryId{1});
  AdaptiveCase adaptive{{{{far, body},
                          {{-4, -4}, {6, -4}, {6, 4}, {-4, 4}, {-1, 0.1}, {1, 0}, {-1, -0.1}},
                          {0, 4, 7},
                          of_segment},
                         {},
                         {},
                         0},
                        {},
                        euler,
                        {"mesh"},
                        {}};
  adaptive.mesh.mesh.size.min = 0.02;
  adaptive.mesh.mesh.size.max = 1;
  LayerLine wake;
  wake.from = {"body"};
  wake.length = 2;
  wake.spacing = 0.2;
  wake.follows_flow = true;
  wake.spacing_at_end = with_layers ? 0 : 0.4;
  wake.without_layers = !with_layers;
  (with_layers ? adaptive.mesh.lines : adaptive.mesh.wakes_without_layers) = {wake};
  adaptive.adapt.cycles = cycles;
  return adaptive;
}

void expect_wake_kept(bool with_layers) {
  const TemporaryFolder folder;
  Heard whole, begun, resumed;
  whole.run(wake_case(2, with_layers), folder.file("whole"), false);
  begun.run(wake_case(1, with_layers), folder.file("parts"), false);
  resumed.run(wake_case(2, with_layers), folder.file("parts"), true);
  EXPECT_EQ(resumed.cycles, (std::vector<int>{2}));
  world().barrier();
  EXPECT_TRUE(io::read_tree(world(), folder.file("whole/cycle_00/mesh.tree.h5")).measured.empty());
  const auto wakes = io::read_tree(world(), folder.file("whole/cycle_01/mesh.tree.h5")).measured.wakes;
  ASSERT_EQ(wakes.size(), 1U);
  EXPECT_EQ(wakes[0].front(), (Point{1, 0}));
  EXPECT_GT(wakes[0].back().y, 0.03) << "upwards, as the flow";
  EXPECT_LT(wakes[0].back().y, 2 * 0.106) << "less than the free stream";
  for (const char* name : {"mesh.mesh", "mesh.tree.h5"})
    EXPECT_TRUE(test::bytes_of(folder.file("whole/cycle_02/") + name) ==
                test::bytes_of(folder.file("parts/cycle_02/") + name))
        << name;
  world().barrier();
}

TEST(RunInFolder, AWakeFollowsTheFlowAndItsTreeKeepsIt) {
  expect_wake_kept(true);
  expect_wake_kept(false);
}

TEST(RunInFolder, ThicknessFollowsTheFlowAndItsTreeKeepsIt) {
  const TemporaryFolder folder;
  Heard whole, begun, resumed;
  whole.run(floor_case(2, true), folder.file("whole"), false);
  begun.run(floor_case(1, true), folder.file("parts"), false);
  resumed.run(floor_case(2, true), folder.file("parts"), true);
  world().barrier();
  const auto thickness = [&](const std::string& cycle) {
    return io::read_tree(world(), folder.file("whole/" + cycle + "/mesh.tree.h5")).measured.thickness;
  };
  EXPECT_TRUE(thickness("cycle_00").empty());
  EXPECT_FALSE(thickness("cycle_01").empty());
  EXPECT_NE(thickness("cycle_02"), thickness("cycle_01"));
  for (const char* name : {"mesh.mesh", "mesh.tree.h5"})
    EXPECT_TRUE(test::bytes_of(folder.file("whole/cycle_02/") + name) ==
                test::bytes_of(folder.file("parts/cycle_02/") + name))
        << name;
  const std::string log = test::bytes_of(folder.file("whole/cycle_02/log.txt")),
                    record = test::bytes_of(folder.file("whole/cycle_02/record.json"));
  EXPECT_NE(log.find("target thickness of layers on floor: 0."), std::string::npos) << log;
  EXPECT_NE(record.find("\"layer_thickness\": {\"floor\": [0."), std::string::npos) << record;
  world().barrier();
}

TEST(RunInFolder, AnotherCaseIsNotGoneOnWith) {
  const TemporaryFolder folder;
  Heard heard;
  heard.run(vortex_case(0), folder.file("run"), false);
  AdaptiveCase other = vortex_case(1);
  other.settings.emplace_back("spacing.min", "0.1");
  EXPECT_THROW(heard.run(other, folder.file("run"), true), InputError);
  AdaptiveCase longer = vortex_case(1);
  longer.settings[0].second = "4";
  heard.run(longer, folder.file("run"), true);
  ASSERT_EQ(heard.warnings.size(), 1U);
  EXPECT_TRUE(heard.warnings[0].starts_with("solver.iterations was 3, is now 4")) << heard.warnings[0];
  EXPECT_THROW(heard.run(longer, folder.file("run"), false), InputError) << "the folder is not empty";
}

/// Changes one digit of the last value in a file.
void change_a_digit(const std::string& path) {
  std::string text = test::bytes_of(path);
  const std::size_t at = text.find_last_of("0123456789");
  text[at] = text[at] == '1' ? '2' : '1';
  std::ofstream(path, std::ios::binary) << text;
}

TEST(RunInFolder, ASolutionWithAnotherValueIsNotGoneOnFrom) {
  const TemporaryFolder folder;
  Heard heard;
  heard.run(vortex_case(0), folder.file("run"), false);
  world().barrier();
  const std::string mesh = folder.file("run/cycle_00/mesh.mesh");
  if (world().is_root()) change_a_digit(mesh);
  world().barrier();
  ASSERT_TRUE(io::read_mesh(mesh).solution.has_value()) << "the file is whole";
  try {
    heard.run(vortex_case(1), folder.file("run"), true);
    FAIL() << "the run goes on from a damaged solution";
  } catch (const InputError& fault) {
    EXPECT_TRUE(std::string(fault.what()).starts_with(mesh)) << fault.what();
    EXPECT_NE(std::string(fault.what()).find("remove the folder"), std::string::npos) << fault.what();
  }
}

TEST(CommandSolver, TheStartingStateIsOfTheSolutionsFormatWhereItStandsAlone) {
  CommandSolver solver;
  solver.mesh = "a.su2";
  solver.solution = "restart.dat";
  EXPECT_EQ(solver.state(), "a.dat");
}

TEST(CommandSolver, TheStartingStateStandsWhereTheFormatHasAPlaceForIt) {
  CommandSolver solver;
  EXPECT_EQ(solver.state(), "mesh.mesh");
  for (const auto& [mesh, state] :
       {std::pair{"a.vtu", "a.vtu"}, {"a.cgns", "a.cgns"}, {"a.su2", "a.csv"}, {"a.msh", "a.csv"}}) {
    solver.mesh = mesh;
    EXPECT_EQ(solver.state(), state);
  }
}

/// Copies the mesh with its state as it is, or leaves what is no solution.

}  // namespace
}  // namespace quadloop::adapt
