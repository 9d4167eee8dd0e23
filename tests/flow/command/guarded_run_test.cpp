// What a program finds when it starts, and how its end is told.
#include "flow/command/guarded_run.hpp"

#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>

#include "tests/flow/command/solver_scripts.hpp"

namespace quadloop::flow {
namespace {

using test::bytes_of;
using test::CycleFolder;

Launch launch_in(const CycleFolder& folder, std::vector<std::string> arguments) {
  const std::string program = arguments.front();
  return {program,       std::move(arguments), {"PATH=/usr/bin:/bin", "A=b c"},
          folder.path(), folder.file("log"),   30};
}

Ending run(const CycleFolder& folder, const std::vector<std::string>& arguments) {
  return run_to_its_end(launch_in(folder, arguments));
}

TEST(GuardedRun, GivesFolderEnvironmentAndEmptyInput) {
  const CycleFolder folder;
  run(folder, {"/bin/sh", "-c", "cat; pwd -P; echo \"$A\"; echo wrong >&2; env | wc -l"});
  EXPECT_EQ(bytes_of(folder.file("log")), folder.path() + "\nb c\nwrong\n3\n");  // sh adds PWD
}

TEST(GuardedRun, PassesOnNoDescriptorAndNoSignalState) {
  const CycleFolder folder;
  std::signal(SIGUSR1, SIG_IGN);
  sigset_t blocked, before;
  sigemptyset(&blocked);
  sigaddset(&blocked, SIGTERM);
  sigprocmask(SIG_BLOCK, &blocked, &before);
  run(folder, {"/bin/ls", "/proc/self/fd"});
  EXPECT_EQ(bytes_of(folder.file("log")), "0\n1\n2\n3\n");  // 3: the folder that ls reads
  run(folder, {"/bin/grep", "-E", "^Sig(Blk|Ign)", "/proc/self/status"});
  EXPECT_EQ(bytes_of(folder.file("log")), "SigBlk:\t0000000000000000\nSigIgn:\t0000000000000000\n");
  std::signal(SIGUSR1, SIG_DFL);
  sigprocmask(SIG_SETMASK, &before, nullptr);
}

TEST(GuardedRun, TellsHowItEnded) {
  const CycleFolder folder;
  const auto outcome = [&](const std::string& lines) {
    const Ending ending = run(folder, {"/bin/sh", "-c", lines});
    return std::pair(ending.kind, ending.value);
  };
  EXPECT_EQ(outcome("exit 0"), std::pair(Ending::Kind::status, 0));
  EXPECT_EQ(outcome("exit 127"), std::pair(Ending::Kind::status, 127));
  EXPECT_EQ(outcome("kill -SEGV $$"), std::pair(Ending::Kind::signal, SIGSEGV));
  EXPECT_EQ(outcome("kill -9 $PPID; sleep 1000").first, Ending::Kind::guard_lost);
}

TEST(GuardedRun, ScriptWithoutInterpreterIsNotGivenToAShell) {
  const CycleFolder folder;
  folder.script("exit 0");
  folder.write("solver.sh", "touch made\n");
  const Ending ending = run(folder, {folder.file("solver.sh")});
  EXPECT_EQ(ending.kind, Ending::Kind::not_started);
  EXPECT_EQ(ending.value, ENOEXEC);
  EXPECT_NE(access(folder.file("made").c_str(), F_OK), 0);
}

TEST(GuardedRun, GuardLostTakesTheProgramAlong) {
  const CycleFolder folder;
  EXPECT_EQ(run(folder, {"/bin/sh", "-c", "echo $$ > self; kill -9 $PPID; sleep 1000"}).kind,
            Ending::Kind::guard_lost);
  EXPECT_TRUE(test::vanishes(test::written_process(folder.file("self"))));
}

TEST(GuardedRun, ProcessesLeftBehindAreEnded) {
  const CycleFolder folder;
  const Ending ending = run(folder, {"/bin/sh", "-c", test::start_stubborn_processes + "exit 5"});
  EXPECT_EQ(ending.kind, Ending::Kind::status);
  EXPECT_EQ(ending.value, 5);
  for (const std::string& name : test::stubborn_processes)
    EXPECT_TRUE(test::vanishes(test::written_process(folder.file(name)))) << name;
}

TEST(GuardedRun, TimeIsOverForTheWholeTree) {
  const CycleFolder folder;
  Launch launch = launch_in(
      folder,
      {"/bin/sh", "-c", test::start_stubborn_processes + "echo $$ > self; while :; do sleep 1; done"});
  launch.timeout = 0.5;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(run_to_its_end(launch).kind, Ending::Kind::timed_out);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(seconds.count(), 0.5);
  EXPECT_LT(seconds.count(), 6);
  EXPECT_TRUE(test::vanishes(test::written_process(folder.file("self"))));
  for (const std::string& name : test::stubborn_processes)
    EXPECT_TRUE(test::vanishes(test::written_process(folder.file(name)))) << name;
}

TEST(GuardedRun, ProgramMayTidyUpWhenItsTimeIsOver) {
  const CycleFolder folder;
  Launch launch =
      launch_in(folder, {"/bin/sh", "-c", "trap 'echo tidy; exit 0' TERM; while :; do sleep 0.05; done"});
  launch.timeout = 0.3;
  EXPECT_EQ(run_to_its_end(launch).kind, Ending::Kind::timed_out);
  EXPECT_TRUE(test::holds(bytes_of(folder.file("log")), "tidy"));
}

/// As mpirun binds a rank to a core.
TEST(GuardedRun, ProgramRunsWhereTheLauncherMayRun) {
  cpu_set_t all, one;
  ASSERT_EQ(sched_getaffinity(getppid(), sizeof all, &all), 0);
  cpu_set_t before;
  ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
  int first = 0;
  while (!CPU_ISSET(first, &before)) ++first;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  const CycleFolder folder;
  run(folder, {"/usr/bin/nproc"});
  EXPECT_EQ(bytes_of(folder.file("log")), "1\n");
  setenv("OMPI_COMM_WORLD_RANK", "0", 1);
  run(folder, {"/usr/bin/nproc"});
  EXPECT_EQ(bytes_of(folder.file("log")), std::to_string(CPU_COUNT(&all)) + "\n");
  unsetenv("OMPI_COMM_WORLD_RANK");
  sched_setaffinity(0, sizeof before, &before);
}

}  // namespace
}  // namespace quadloop::flow
