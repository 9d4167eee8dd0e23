// Programs are found as a user expects, and what is wrong is said before anything runs.
#include "flow/command/program.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/flow/command/solver_scripts.hpp"

namespace quadloop::flow {
namespace {

using test::CycleFolder;

std::string message_of(const std::string& name, const std::string& search, const std::string& folder) {
  const test::Refusal refusal = test::refusal_of([&] { find_program(name, search, folder); });
  EXPECT_EQ(refusal.status, ExitStatus::bad_input);
  return refusal.message;
}

TEST(Program, IsLookedUpInPath) {
  EXPECT_EQ(find_program("sh", "/nowhere:/bin", "/tmp"), "/bin/sh");
  const CycleFolder folder;
  folder.script("exit 0");
  EXPECT_EQ(find_program("solver.sh", "/bin:" + folder.path(), "/"), folder.file("solver.sh"));
}

TEST(Program, WithASlashIsAPath) {
  const CycleFolder folder;
  folder.script("exit 0");
  EXPECT_EQ(find_program("/bin/sh", "", "/tmp"), "/bin/sh");
  EXPECT_EQ(find_program("./solver.sh", "", folder.path()), folder.path() + "/./solver.sh");
}

TEST(Program, ThatIsMissingIsNamedWithTheCure) {
  EXPECT_EQ(message_of("no_such_solver", "/bin:/usr/bin", "/tmp"),
            "[solver] command: the program 'no_such_solver' is in no folder of PATH; install it, write its "
            "full path, or {case}/no_such_solver for one "
            "beside the case file");
  EXPECT_TRUE(test::holds(message_of("bin/run", "/bin", "/tmp"),
                          "write {case}/bin/run for one beside the case file"));
  EXPECT_TRUE(test::holds(message_of("/no/such/solver", "/bin", "/tmp"), "'/no/such/solver' is no file"));
  message_of("", "/bin", "/tmp");
  message_of("/bin", "/bin", "/tmp");
}

TEST(Program, ThatMayNotBeRunIsSaid) {
  const CycleFolder folder;
  folder.write("run", "#!/bin/sh\n");
  EXPECT_TRUE(test::holds(message_of(folder.file("run"), "", "/"), "chmod +x " + folder.file("run")));
  message_of("run", folder.path(), "/");
}

}  // namespace
}  // namespace quadloop::flow
