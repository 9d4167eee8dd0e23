// A cycle's run of the solver: what it gets, what it must leave, and what all ranks are told of a failure.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

#include "tests/flow/command/solver_scripts.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow {
namespace {

using test::bytes_of;
using test::CycleFolder;
using test::holds;
using test::Refusal;
using test::world;

Refusal refusal(const SolverCommand& command, const CycleFolder& folder) {
  return test::refusal_of([&] { run_solver(world(), command, folder.files()); });
}

/// The message of a SolverError, the same on all ranks.
std::string failure(const SolverCommand& command, const CycleFolder& folder) {
  const Refusal found = refusal(command, folder);
  EXPECT_EQ(found.status, ExitStatus::solver_failed) << found.message;
  std::vector<char> of_root(found.message.begin(), found.message.end());
  world().broadcast(of_root);
  EXPECT_EQ(found.message, std::string(of_root.begin(), of_root.end()));
  return found.message;
}

TEST(RunSolver, RunsOnceWithItsArgumentsAndKeepsItsLog) {
  const CycleFolder folder;
  SolverCommand command =
      folder.script("echo run >> runs; echo out; echo err >&2; shift; printf '%s\\n' \"$@\" > solution.mesh");
  command.arguments.insert(command.arguments.end(), {"$(touch x); *", "", "{cycle} {ranks}"});
  run_solver(world(), command, folder.files());
  EXPECT_EQ(bytes_of(folder.file("runs")), "run\n");
  EXPECT_EQ(bytes_of(folder.file("solution.mesh")), "$(touch x); *\n\n4 6\n");
  EXPECT_EQ(bytes_of(folder.file("solver.log")), "out\nerr\n");
  EXPECT_FALSE(std::filesystem::exists(folder.file("x")));
}

TEST(RunSolver, StatusIsToldWithTheLastLine) {
  const CycleFolder folder;
  const SolverCommand command =
      folder.script("for i in 1 2 3 4 5 6 7; do echo line $i; done; echo density is negative >&2; exit 7");
  EXPECT_EQ(failure(command, folder), "the solver '{case}/solver.sh' of cycle 4 ended with exit status 7; " +
                                          folder.file("solver.log") + " ends: density is negative");
}

TEST(RunSolver, OfATracebackTheErrorIsTold) {
  const CycleFolder folder;
  const SolverCommand command = folder.script(
      "printf 'Traceback (most recent call last):\\n  File \"solver.py\", line 3, in <module>\\n    "
      "solve(mesh)\\n    ~~~~~^^^^^^\\n"
      "ValueError: the density is negative\\n-------\\n\\n' >&2; exit 1");
  const std::string message = failure(command, folder);
  EXPECT_TRUE(holds(message, folder.file("solver.log") + " ends: ValueError: the density is negative"))
      << message;
  EXPECT_FALSE(holds(message, "Traceback")) << message;
}

TEST(RunSolver, SignalIsNamed) {
  const CycleFolder folder;
  EXPECT_TRUE(holds(failure(folder.script("kill -SEGV $$"), folder),
                    "was killed by signal 11 (Segmentation fault); it wrote nothing to its log, " +
                        folder.file("solver.log")));
  EXPECT_TRUE(holds(failure(folder.script("kill -9 $$"), folder),
                    "was killed by signal 9 (Killed), by a user or because memory ran out"));
}

TEST(RunSolver, TimeIsLimited) {
  const CycleFolder folder;
  SolverCommand command = folder.script("echo begun; sleep 1000 & echo $! > child; wait");
  command.timeout = 0.5;
  const std::string message = failure(command, folder);
  EXPECT_TRUE(holds(message, "had not ended after 0.5 s and was stopped")) << message;
  EXPECT_TRUE(holds(message, "ends: begun")) << message;
  EXPECT_TRUE(test::vanishes(test::written_process(folder.file("child"))));
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    command.timeout = wrong;
    EXPECT_EQ(refusal(command, folder).status, ExitStatus::bad_input);
  }
}

TEST(RunSolver, MissingProgramIsRefusedBeforeAnythingIsTouched) {
  const CycleFolder folder;
  folder.write("solution.mesh", "old");
  EXPECT_EQ(refusal({{"no_such_solver"}, 5}, folder).status, ExitStatus::bad_input);
  EXPECT_EQ(refusal({{"sh", "{meshes}"}, 5}, folder).status, ExitStatus::bad_input);
  EXPECT_EQ(bytes_of(folder.file("solution.mesh")), "old");
}

TEST(RunSolver, ScriptWithoutInterpreterIsToldWithTheCure) {
  const CycleFolder folder;
  const SolverCommand command = folder.script("");
  folder.write("solver.sh", "touch x\n");
  EXPECT_TRUE(holds(failure(command, folder),
                    "cannot be started: Exec format error (a script must begin with a line as #!/bin/sh)"));
}

TEST(RunSolver, SolutionOfAnEarlierRunDoesNotPass) {
  const CycleFolder folder;
  folder.write("solution.mesh", "old");
  const std::string message = failure(folder.script("echo all is well"), folder);
  EXPECT_TRUE(holds(message, "ended without leaving its solution, " + folder.file("solution.mesh")))
      << message;
  EXPECT_TRUE(holds(message, "ends: all is well")) << message;
  EXPECT_TRUE(holds(failure(folder.script("cp -p solver.sh $1; touch -d '1 hour ago' $1"), folder),
                    "left a file older than its run"));
}

TEST(RunSolver, SolutionMustBeAFileWithContent) {
  const CycleFolder folder;
  EXPECT_TRUE(holds(failure(folder.script(": > $1"), folder),
                    "left an empty solution, " + folder.file("solution.mesh")));
  EXPECT_TRUE(
      holds(failure(folder.script("mkdir $1"), folder), "left something that is no file as its solution"));
  EXPECT_EQ(refusal(folder.script("echo"), folder).status,
            ExitStatus::bad_input);  // the folder is still there
}

TEST(RunSolver, SolutionMayBeALink) {
  const CycleFolder folder;
  run_solver(world(), folder.script("echo 1 > latest; ln -s latest $1"), folder.files());
  run_solver(world(), folder.script("echo 2 > $1"), folder.files());  // the link goes, not what it points to
  EXPECT_EQ(bytes_of(folder.file("latest")), "1\n");
}

TEST(RunSolver, MeshIsNotTakenForAnOldSolution) {
  const CycleFolder folder;
  folder.write("mesh.mesh", "mesh");
  SolverFiles files = folder.files();
  files.solution = folder.file("./mesh.mesh");
  const SolverCommand command = folder.script("echo > $1");
  EXPECT_EQ(test::refusal_of([&] { run_solver(world(), command, files); }).status, ExitStatus::bad_input);
  EXPECT_EQ(bytes_of(folder.file("mesh.mesh")), "mesh");
}

TEST(RunSolver, LauncherVariablesAreGone) {
  const CycleFolder folder;
  run_solver(world(),
             folder.script("env | grep -cE '^(OMPI_COMM_WORLD|OMPI_MCA_orte|OMPI_MCA_ess|PMIX|PMI_)' > $1; "
                           "pwd -P >> $1; echo $PWD >> $1"),
             folder.files());
  EXPECT_EQ(bytes_of(folder.file("solution.mesh")), "0\n" + folder.path() + "\n" + folder.path() + "\n");
}

TEST(RunSolver, SolverMayBeAnMpirunOfItsOwn) {
  const CycleFolder folder;
  const SolverCommand script = folder.script("echo of $OMPI_COMM_WORLD_SIZE; echo done > $1");
  const SolverCommand command{{"mpirun", "-n", "2", "--oversubscribe", "{case}/solver.sh", "{solution}"}, 30};
  const Refusal found = refusal(command, folder);
  EXPECT_EQ(found.status, ExitStatus::done) << found.message;
  EXPECT_EQ(bytes_of(folder.file("solver.log")), "of 2\nof 2\n");
}

TEST(RunSolver, MessageCanBeMadeForWhatItWrote) {
  const CycleFolder folder;
  run_solver(world(), folder.script("echo nan > $1; echo diverged"), folder.files());
  EXPECT_EQ(
      solver_message({{"my_solver"}, 1}, folder.files(), "left rubbish"),
      "the solver 'my_solver' of cycle 4 left rubbish; " + folder.file("solver.log") + " ends: diverged");
}

}  // namespace
}  // namespace quadloop::flow
