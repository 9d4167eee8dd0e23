// However quadloop ends, everything that its solver has started ends too.
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>

#include <csignal>

#include "flow/command/environment.hpp"
#include "tests/flow/command/solver_scripts.hpp"

namespace quadloop::flow {
namespace {

using test::CycleFolder;

/// A run of the probe, a small quadloop.
class Probe {
 public:
  explicit Probe(const CycleFolder& folder) {
    std::string program = SOLVER_PROBE, path = folder.path();
    std::vector<std::string> environment = environment_for(path);
    std::vector<char*> variables;
    for (std::string& variable : environment) variables.push_back(variable.data());
    variables.push_back(nullptr);
    char* arguments[] = {program.data(), path.data(), nullptr};
    EXPECT_EQ(posix_spawn(&process_, SOLVER_PROBE, nullptr, nullptr, arguments, variables.data()), 0);
  }
  void stop() const { kill(process_, SIGSTOP); }
  void end_by(int signal_number) const {
    kill(process_, signal_number);
    int status = 0;
    EXPECT_EQ(waitpid(process_, &status, 0), process_);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal_number);
  }

 private:
  pid_t process_ = 0;
};

/// By the kernel alone: quadloop cannot act here.
TEST(EndedWithGuard, TheSolverItself) {
  const CycleFolder folder;
  folder.script("echo $PPID > guard; echo $$ > self; while :; do sleep 0.1; done");
  const Probe probe(folder);
  const pid_t guard = test::written_process(folder.file("guard")),
              solver = test::written_process(folder.file("self"));
  ASSERT_GT(guard, 0);
  ASSERT_GT(solver, 0);
  probe.stop();
  kill(guard, SIGKILL);
  EXPECT_TRUE(test::vanishes(solver));
  probe.end_by(SIGKILL);
}

class EndedWithQuadloop : public testing::TestWithParam<int> {};

TEST_P(EndedWithQuadloop, AllProcessesOfTheSolver) {
  const CycleFolder folder;
  folder.script(test::start_stubborn_processes + "echo $$ > self; while :; do sleep 1; done");
  const Probe probe(folder);
  std::vector<pid_t> processes{test::written_process(folder.file("self"))};
  for (const std::string& name : test::stubborn_processes)
    processes.push_back(test::written_process(folder.file(name)));
  for (const pid_t process : processes) {
    ASSERT_GT(process, 0);
    EXPECT_EQ(kill(process, 0), 0);
  }
  probe.end_by(GetParam());
  for (const pid_t process : processes) EXPECT_TRUE(test::vanishes(process));
}

INSTANTIATE_TEST_SUITE_P(Signals, EndedWithQuadloop, testing::Values(SIGKILL, SIGTERM, SIGINT),
                         [](const testing::TestParamInfo<int>& signal) {
                           return std::string(sigabbrev_np(signal.param));
                         });

}  // namespace
}  // namespace quadloop::flow
