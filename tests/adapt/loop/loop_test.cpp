// The loop in memory, with a solver of a few lines: each cycle's mesh is finer where the flow changes, the
// flow is transferred, and one rank alone finds the same.
#include "adapt/loop/loop.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/base/error.hpp"
#include "tests/adapt/loop/shock_in_square.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::all_nodes;
using test::options_of;
using test::solve_constant;
using test::solve_shock;
using test::square_in_eighths;
using test::world;

/// What is called in which order, and the states that solvers start from.
class Notes final : public CycleObserver {
 public:
  void begin(int cycle) override { calls += "b" + std::to_string(cycle); }
  void meshed(const MeshResult&, const Field& start) override { calls += start.width() > 0 ? "M" : "m"; }
  std::vector<std::string> solved(const Mesh&, const flow::SolvedFlow&) override {
    calls += "s";
    return {"from the observer"};
  }
  void finished(CycleRecord record, const std::vector<std::string>&,
                const std::vector<std::string>& warnings) override {
    calls += "f ";
    records.push_back(record);
    told = warnings;
  }

  std::string calls;
  std::vector<CycleRecord> records;
  std::vector<std::string> told;
};

TEST(Loop, RefinesWhereTheFlowChangesAndIsTheSameOnOneRank) {
  Notes notes;
  const LoopEnd end = run_loop(world(), square_in_eighths, options_of(2), solve_shock, notes);
  EXPECT_EQ(notes.calls, "b0msf b1Msf b2Msf ");
  ASSERT_EQ(notes.records.size(), 3U);
  EXPECT_GT(notes.records[1].nodes, notes.records[0].nodes);
  EXPECT_GT(notes.records[2].nodes, notes.records[1].nodes);
  EXPECT_LT(std::abs(notes.records[2].drift.at(0).second), 0.01);
  EXPECT_EQ(end.first, 0);
  EXPECT_EQ(end.last, 2);
  EXPECT_FALSE(end.nothing_to_change);

  const Communicator alone(MPI_COMM_SELF);
  Notes of_one;
  const LoopEnd on_one = run_loop(alone, square_in_eighths, options_of(2), solve_shock, of_one);
  ASSERT_TRUE(end.left && on_one.left);
  EXPECT_EQ(all_nodes(world(), end.left->solved.mesh), all_nodes(alone, on_one.left->solved.mesh));
  EXPECT_EQ(notes.records[2].drift, of_one.records[2].drift);
}

TEST(Loop, BeginsWithTheLastFlowCarriedOver) {
  double worst = 0;
  const flow::FlowSolver solver = [&](const Communicator& comm, const Mesh& mesh, const Field& start,
                                      int cycle) {
    for (std::int32_t i = 0; cycle > 0 && i < mesh.owned_nodes; ++i)
      worst =
          std::max(worst, std::abs(start.row(NodeId{i})[0] - test::circular_shock(mesh.point(NodeId{i}))));
    return solve_shock(comm, mesh, start, cycle);
  };
  Notes notes;
  run_loop(world(), square_in_eighths, options_of(3), solver, notes);
  EXPECT_GT(world().maximum(worst), 1e-4);  // linear between the nodes of a coarser mesh
  EXPECT_LT(world().maximum(worst), 0.9);
}

TEST(Loop, GoesOnFromWhatACycleCameTo) {
  Notes notes;
  const LoopEnd whole = run_loop(world(), square_in_eighths, options_of(2), solve_shock, notes);
  const LoopEnd begun = run_loop(world(), square_in_eighths, options_of(1), solve_shock, notes);
  const LoopEnd resumed =
      run_loop(world(), square_in_eighths, options_of(2), solve_shock, notes, {2, begun.left, {}});
  EXPECT_EQ(resumed.first, 2);
  EXPECT_EQ(resumed.last, 2);
  EXPECT_EQ(all_nodes(world(), whole.left->solved.mesh), all_nodes(world(), resumed.left->solved.mesh));
}

TEST(Loop, EndsWhereNothingIsToBeChanged) {
  Notes notes;
  const LoopEnd end = run_loop(world(), square_in_eighths, options_of(5), solve_constant, notes);
  EXPECT_TRUE(end.nothing_to_change);
  EXPECT_EQ(end.last, 0);
  ASSERT_EQ(notes.told.size(), 2U);
  EXPECT_EQ(notes.told[0], "from the observer");
  EXPECT_NE(notes.told[1].find("is constant"), std::string::npos) << notes.told[1];
}

/// One rank asks for it, in the middle of a cycle: this one is finished on all ranks, and the rest is as
/// ever.
TEST(Loop, EndsBetweenTwoCyclesOnRequest) {
  Notes notes, of_rest;
  bool requested = false;
  AdaptOptions options = options_of(2);
  AdaptiveLoop loop(world(), square_in_eighths, options, notes);
  loop.stop_when([&] { return requested; });
  const flow::FlowSolver solver = [&](const Communicator& comm, const Mesh& mesh, const Field& start,
                                      int cycle) {
    requested = cycle == 1 && comm.rank() == comm.size() - 1;
    return solve_shock(comm, mesh, start, cycle);
  };
  const LoopEnd end = run_to_end(world(), loop, solver);
  EXPECT_TRUE(end.stopped);
  EXPECT_EQ(end.last, 1);
  const LoopEnd rest = run_loop(world(), square_in_eighths, options, solve_shock, of_rest, {2, end.left, {}});
  const LoopEnd whole = run_loop(world(), square_in_eighths, options, solve_shock, of_rest);
  EXPECT_FALSE(whole.stopped);
  EXPECT_EQ(all_nodes(world(), whole.left->solved.mesh), all_nodes(world(), rest.left->solved.mesh));
}

/// A run that has come to its end was not stopped.
TEST(Loop, IsNotStoppedAfterItsLastCycle) {
  Notes notes;
  AdaptOptions options = options_of(0);
  AdaptiveLoop loop(world(), square_in_eighths, options, notes);
  bool requested = false;
  loop.stop_when([&] { return requested; });
  const LoopEnd end =
      run_to_end(world(), loop, [&](const auto& comm, const auto& mesh, const auto& start, int cycle) {
        requested = true;
        return solve_shock(comm, mesh, start, cycle);
      });
  EXPECT_FALSE(end.stopped);
  EXPECT_EQ(end.last, 0);
}

TEST(Loop, HandsOnWhatTheSolverThrows) {
  const flow::FlowSolver failing = [](const Communicator&, const Mesh&, const Field&,
                                      int) -> flow::SolvedFlow { throw SolverError("no flow today"); };
  Notes notes;
  EXPECT_THROW(run_loop(world(), square_in_eighths, options_of(1), failing, notes), SolverError);
  EXPECT_EQ(notes.calls, "b0m");
}

}  // namespace
}  // namespace quadloop::adapt
