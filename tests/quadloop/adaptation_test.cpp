// Progress and cancellation, and the loop with the solver of the case.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "mesher/mesh/scatter_mesh.hpp"
#include "quadloop/quadloop.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

const std::string outline =
    "[[shape]]\nname = \"side\"\nkind = \"polygon\"\npoints = [[0, 0], [1, 0.1], [1, 1], [0, 0.8]]\n"
    "[spacing]\nmin = 0.02\nmax = 0.1\n[boundary.side]\nbc = \"farfield\"\n";

Case case_of(const std::string& more) { return {world(), CaseSource("case", outline + more)}; }

Case front_case() { return case_of("[adapt]\nvariable = \"q\"\ncycles = 2\nmin = 0.005\n"); }

SolvedFlow front(const Mesh& mesh) {
  SolvedFlow flow;
  flow.solution.names = {"q"};
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i)
    flow.solution.values.push_back(std::tanh(40 * (mesh.point(NodeId{i}).x - 0.4)));
  return flow;
}

/// Returns false at its n-th call, on the last rank.
ProgressCallback cancels_at(int n) {
  return [n](const Progress&) mutable { return --n != 0 || world().rank() < world().size() - 1; };
}

TEST(Adaptation, StagesAreReported) {
  std::set<std::string> stages;
  std::set<int> cycles;
  double largest = 0;
  const auto listen = [&](const Progress& progress) {
    stages.insert(progress.stage);
    cycles.insert(progress.cycle);
    largest = std::max(largest, progress.share);
    return true;
  };
  make_mesh(world(), front_case(), listen);
  EXPECT_EQ(stages, (std::set<std::string>{"refinement", "cutting", "cells", "smoothing"}));
  EXPECT_EQ(cycles, (std::set<int>{-1}));
  EXPECT_GT(largest, 0);
  stages.clear();
  Mesh mesh = make_mesh(world(), case_of("[smooth]\nsweeps = 0\n")).solved.mesh;
  smooth(world(), front_case(), mesh, listen);
  EXPECT_EQ(stages, (std::set<std::string>{"smoothing"}));
  cycles.clear();
  Adaptation run(world(), front_case(), {.progress = listen});
  while (run.begin_cycle()) run.finish_cycle(front(run.solved()->mesh));
  EXPECT_EQ(cycles, (std::set<int>{0, 1, 2}));
  EXPECT_TRUE(stages.contains("transfer") && stages.contains("planning"));
}

TEST(Adaptation, AnyStageCanBeCancelledByAnyRank) {
  int calls = 0;
  const Mesh mesh =
      make_mesh(world(), front_case(), [&](const Progress&) { return ++calls > 0; }).solved.mesh;
  ASSERT_GT(calls, 4);
  for (int n = 1; n <= calls; ++n)
    EXPECT_THROW(make_mesh(world(), front_case(), cancels_at(n)), Cancelled) << n;
  EXPECT_EQ(make_mesh(world(), front_case(), cancels_at(calls + 1)).solved.mesh.points, mesh.points);
}

/// The names of the files in a folder, on the root.
std::set<std::string> files_in(const std::string& folder) {
  std::set<std::string> names;
  world().barrier();
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    names.insert(std::filesystem::relative(entry.path(), folder));
  world().barrier();
  return names;
}

TEST(Adaptation, ACancelledRunLeavesWholeCyclesAndGoesOn) {
  const test::TemporaryFolder folder;
  Adaptation whole(world(), front_case());
  while (whole.begin_cycle()) whole.finish_cycle(front(whole.solved()->mesh));
  bool cancels = false;
  const auto callback = [&](const Progress& progress) {
    return !cancels || progress.cycle != 1 || progress.stage != "cells" || world().rank() > 0;
  };
  {
    Adaptation run(world(), front_case(), {.folder = folder.file("run"), .progress = callback});
    ASSERT_TRUE(run.begin_cycle());
    run.finish_cycle(front(run.solved()->mesh));
    const std::set<std::string> complete = files_in(folder.file("run"));
    cancels = true;
    EXPECT_THROW(run.begin_cycle(), Cancelled);
    EXPECT_NE(files_in(folder.file("run")), complete) << "the cycle has begun";
    cancels = false;
    ASSERT_TRUE(run.begin_cycle());
    EXPECT_EQ(run.cycle(), 1);
    run.finish_cycle(front(run.solved()->mesh));
    ASSERT_TRUE(run.begin_cycle());  // and is not finished
  }
  const std::set<std::string> files = files_in(folder.file("run"));
  EXPECT_TRUE(files.contains("cycle_01"));
  EXPECT_FALSE(files.contains("cycle_02") || files.contains("cycle_02.part"));
  Adaptation rest(world(), front_case(), {.folder = folder.file("run"), .resume = true});
  ASSERT_TRUE(rest.begin_cycle());
  EXPECT_EQ(gather_whole(world(), rest.solved()->mesh).points,
            gather_whole(world(), whole.solved()->mesh).points);
}

const char* const flow_of_case =
    "[solver]\nmach = 0.3\niterations = 5\n[adapt]\nvariable = \"density\"\ncycles = 1\n";

TEST(Adaptation, TheSolverOfTheCaseCanRun) {
  const Case of_flow = case_of(flow_of_case);
  const FlowSolver solver = built_in_solver(world(), of_flow);
  Adaptation own(world(), of_flow, {.solving = Solving::by_solver_of_case}), by_caller(world(), of_flow);
  while (by_caller.begin_cycle()) {
    ASSERT_TRUE(own.begin_cycle());
    const SolvedFlow flow = own.solve();
    const SolvedFlow other =
        solver(world(), by_caller.solved()->mesh, by_caller.initial_state(), by_caller.cycle());
    EXPECT_EQ(flow.solution.values, other.solution.values);
    own.finish_cycle(flow);
    by_caller.finish_cycle(other);
  }
  EXPECT_FALSE(own.begin_cycle());
}

TEST(Adaptation, TheSolverOfTheCaseCanBeCancelled) {
  int steps = 0;
  const auto callback = [&](const Progress& progress) {
    return progress.stage != "solving" || ++steps < 2 || world().rank() > 0;
  };
  Adaptation run(world(), case_of(flow_of_case),
                 {.solving = Solving::by_solver_of_case, .progress = callback});
  ASSERT_TRUE(run.begin_cycle());
  EXPECT_THROW(run.solve(), Cancelled);
  EXPECT_EQ(steps, 2) << "the second report is that of the first step";
}

TEST(Adaptation, WhatCannotSolveIsRefused) {
  Adaptation run(world(), front_case());
  ASSERT_TRUE(run.begin_cycle());
  EXPECT_THROW(run.solve(), InputError);
  const Case of_program = case_of(
      "[solver]\nkind = \"command\"\ncommand = [\"true\"]\nmesh = \"m.su2\"\nsolution = \"s.csv\"\n"
      "[adapt]\nvariable = \"q\"\ncycles = 1\n");
  EXPECT_THROW(Adaptation(world(), of_program, {.solving = Solving::by_solver_of_case}), InputError);
  EXPECT_THROW(Adaptation(world(), case_of("[adapt]\ncycles = 1\npasses = 2\n")), InputError);
}

}  // namespace
}  // namespace quadloop
