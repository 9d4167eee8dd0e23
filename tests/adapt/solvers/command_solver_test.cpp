// A program as a solver: what it leaves is the solution, spread over the ranks.
#include "adapt/solvers/command_solver.hpp"

#include <gtest/gtest.h>

#include "io/mesh_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::TemporaryFolder, test::world;

CommandSolver shell(const std::string& script) {
  CommandSolver solver;
  solver.command.arguments = {"sh", "-c", script};
  solver.solution = "left.mesh";
  return solver;
}

TEST(CommandSolver, WhatItLeavesIsTheSolution) {
  const TemporaryFolder folder;
  const Mesh whole = test::Grid{4}.mesh();
  const Mesh part = scatter_mesh(world(), whole, own_order(whole));
  Field flow{{"density"}, {}, {}};
  for (std::int32_t i = 0; i < part.owned_nodes; ++i) flow.values.push_back(part.points[i].x + 3);
  io::OutputSet outputs(world());
  io::write_mesh(outputs, part, folder.file("mesh.mesh"), &flow);
  outputs.commit();
  const auto folder_of = [&](int) { return folder.file("."); };
  const auto solve = [&](const std::string& script) {
    return command_solver(shell(script), folder_of)(world(), part, {}, 0);
  };
  const flow::SolvedFlow solved = solve("cp mesh.mesh left.mesh");
  EXPECT_EQ(solved.solution.names, flow.names);
  EXPECT_EQ(solved.solution.values, flow.values);
  EXPECT_FALSE(solved.stream);
  EXPECT_THROW(solve("echo no mesh > left.mesh"), SolverError);
  EXPECT_THROW(solve("rm left.mesh"), SolverError);
  EXPECT_THROW(solve("exit 3"), SolverError);
}

TEST(CommandSolver, TheStateStandsWhereAFormatHasAPlaceForIt) {
  CommandSolver solver;
  EXPECT_EQ(solver.state(), solver.mesh);
  solver.mesh = "flow.su2";
  EXPECT_EQ(solver.state(), "flow.csv");
  solver.solution = "restart.dat";
  EXPECT_EQ(solver.state(), "flow.dat");
}

}  // namespace
}  // namespace quadloop::adapt
