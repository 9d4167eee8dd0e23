// Meshes that are solved roughly before a run's first cycle: it begins with the mesh that so many cycles
// would have led to.
#include "adapt/loop/passes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/adapt/remesh/square_input.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

const MeshInput square_input = test::square_input(0.125);

AdaptOptions options_of(int passes) {
  AdaptOptions options;
  options.passes = passes;
  options.cycles = passes;
  options.variables = {"q"};
  options.min = 1.0 / 256;
  return options;
}

SolvedFlow solve_front(const Communicator&, const Mesh& mesh, const Field&, int) {
  SolvedFlow flow;
  flow.solution.names = {"q"};
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) {
    const Point p = mesh.point(NodeId{i});
    flow.solution.values.push_back(std::tanh(30 * (std::hypot(p.x, p.y) - 0.6)));
  }
  flow.cl = 0.25;
  return flow;
}

std::vector<Point> all_nodes(const Communicator& comm, const Mesh& mesh) {
  return comm.all_gather_values(std::span(mesh.points).first(mesh.owned_nodes));
}

TEST(Passes, LeadToTheMeshOfAsManyCycles) {
  CycleObserver nobody;
  const LoopEnd end = run_loop(world(), square_input, options_of(2), solve_front, nobody);
  const CarriedMesh first = mesh_after_passes(world(), square_input, options_of(2), solve_front);
  ASSERT_TRUE(end.left);
  EXPECT_EQ(all_nodes(world(), first.generated.result.mesh), all_nodes(world(), end.left->solved.mesh));
  EXPECT_EQ(first.start.names, (std::vector<std::string>{"q"}));
  ASSERT_EQ(first.passes.size(), 2U);
  EXPECT_LT(first.passes[0].nodes, first.passes[1].nodes);
  EXPECT_EQ(first.passes[1].cl, 0.25);

  const Communicator alone(MPI_COMM_SELF);
  const CarriedMesh on_one = mesh_after_passes(alone, square_input, options_of(2), solve_front);
  EXPECT_EQ(all_nodes(alone, on_one.generated.result.mesh), all_nodes(world(), first.generated.result.mesh));
}

TEST(Passes, EndWhereAFlowAsksForNoOtherMesh) {
  const FlowSolver constant = [](const Communicator&, const Mesh& mesh, const Field&, int) {
    SolvedFlow flow;
    flow.solution = {{"q"}, std::vector<double>(mesh.owned_nodes, 3.0), {}};
    return flow;
  };
  const CarriedMesh first = mesh_after_passes(world(), square_input, options_of(3), constant);
  EXPECT_EQ(first.passes.size(), 1U);
  const Mesh& mesh = first.generated.result.mesh;
  EXPECT_EQ(world().sum(std::int64_t{mesh.owned_nodes}), first.passes.at(0).nodes);
  EXPECT_EQ(first.start.values, std::vector<double>(mesh.owned_nodes, 3.0));
  const std::vector<std::pair<std::string, double>> none{{"q", 0.0}};
  EXPECT_EQ(first.drifts(), none);
  const std::vector<std::string>& warnings = first.generated.result.report.warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(warnings[0].starts_with("pass 1: no leaf is marked")) << warnings[0];
}

TEST(Passes, StandInTheRecordOfTheFirstCycle) {
  struct Notes final : CycleObserver {
    void finished(CycleRecord record, const std::vector<std::string>&,
                  const std::vector<std::string>&) override {
      records.push_back(std::move(record));
    }
    std::vector<CycleRecord> records;
  } notes;
  AdaptOptions options = options_of(1);
  run_loop(world(), square_input, options, solve_front, notes, 0, {},
           [&] { return mesh_after_passes(world(), square_input, options, solve_front); });
  ASSERT_EQ(notes.records.size(), 2U);
  const std::string first = json_text(notes.records[0]), second = json_text(notes.records[1]);
  EXPECT_NE(first.find("\"passes\": [{\"nodes\": "), std::string::npos) << first;
  EXPECT_EQ(second.find("passes"), std::string::npos) << second;
  EXPECT_EQ(first.find("morphed"), std::string::npos) << "its cells are no other run's";
  EXPECT_EQ(notes.records[0].seconds.at(0).first, "passes");
}

}  // namespace
}  // namespace quadloop
