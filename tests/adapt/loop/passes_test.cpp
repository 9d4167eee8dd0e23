// Meshes that are solved roughly before a run's first cycle: it begins with the mesh that so many cycles
// would have led to.
#include "adapt/loop/passes.hpp"

#include <gtest/gtest.h>

#include "tests/adapt/loop/shock_in_square.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::all_nodes;
using test::square_in_eighths;
using test::world;

AdaptOptions options_with(int passes) {
  AdaptOptions options = test::options_of(passes);
  options.passes = passes;
  return options;
}

flow::SolvedFlow solve_shock_with_lift(const Communicator& comm, const Mesh& mesh, const Field& start,
                                       int cycle) {
  flow::SolvedFlow flow = test::solve_shock(comm, mesh, start, cycle);
  flow.cl = 0.25;
  return flow;
}

TEST(Passes, LeadToTheMeshOfAsManyCycles) {
  CycleObserver nobody;
  const LoopEnd end = run_loop(world(), square_in_eighths, options_with(2), solve_shock_with_lift, nobody);
  const RemeshedSolution first =
      mesh_after_passes(world(), square_in_eighths, options_with(2), solve_shock_with_lift);
  ASSERT_TRUE(end.left);
  EXPECT_EQ(all_nodes(world(), first.generated.result.mesh), all_nodes(world(), end.left->solved.mesh));
  EXPECT_EQ(first.start.names, (std::vector<std::string>{"q"}));
  ASSERT_EQ(first.passes.size(), 2U);
  EXPECT_LT(first.passes[0].nodes, first.passes[1].nodes);
  EXPECT_EQ(first.passes[1].cl, 0.25);

  const Communicator alone(MPI_COMM_SELF);
  const RemeshedSolution on_one =
      mesh_after_passes(alone, square_in_eighths, options_with(2), solve_shock_with_lift);
  EXPECT_EQ(all_nodes(alone, on_one.generated.result.mesh), all_nodes(world(), first.generated.result.mesh));
}

TEST(Passes, EndWhereAFlowAsksForNoOtherMesh) {
  const RemeshedSolution first =
      mesh_after_passes(world(), square_in_eighths, options_with(3), test::solve_constant);
  EXPECT_EQ(first.passes.size(), 1U);
  const Mesh& mesh = first.generated.result.mesh;
  EXPECT_EQ(world().sum(std::int64_t{mesh.owned_nodes}), first.passes.at(0).nodes);
  EXPECT_EQ(first.start.values, std::vector<double>(mesh.owned_nodes, 3.0));
  const std::vector<std::pair<std::string, double>> none{{"q", 0.0}};
  EXPECT_EQ(first.drifts(), none);
  const std::vector<std::string>& warnings = first.generated.result.report.warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(warnings[0].starts_with("pass 1: no cell is refined or coarsened")) << warnings[0];
}

TEST(Passes, StandInTheRecordOfTheFirstCycle) {
  struct RecordsOfCycles final : CycleObserver {
    void finished(CycleRecord record, const std::vector<std::string>&,
                  const std::vector<std::string>&) override {
      records.push_back(std::move(record));
    }
    std::vector<CycleRecord> records;
  } notes;
  AdaptOptions options = options_with(1);
  run_loop(world(), square_in_eighths, options, solve_shock_with_lift, notes, {.mesh = [&] {
             return mesh_after_passes(world(), square_in_eighths, options, solve_shock_with_lift);
           }});
  ASSERT_EQ(notes.records.size(), 2U);
  const std::string first = json_text(notes.records[0]), second = json_text(notes.records[1]);
  EXPECT_NE(first.find("\"passes\": [{\"nodes\": "), std::string::npos) << first;
  EXPECT_EQ(second.find("passes"), std::string::npos) << second;
  EXPECT_EQ(first.find("morphed"), std::string::npos) << "its cells are no other run's";
  EXPECT_EQ(notes.records[0].seconds.at(0).first, "passes");
}

}  // namespace
}  // namespace quadloop::adapt
