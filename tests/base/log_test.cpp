// What is logged, and by whom. On one rank alone.
#include "mesher/base/log.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace quadloop {
namespace {

/// What stands on stderr after one message of each kind.
std::string said() {
  testing::internal::CaptureStderr();
  log::warning("a {} b");
  log::information("info");
  log::detail("detail");
  return testing::internal::GetCapturedStderr();
}

std::string said(const log::Options& options) {
  log::configure(options);
  const std::string text = said();
  log::configure({});
  return text;
}

// The first of this program that logs: nothing is configured yet.
TEST(Log, UnconfiguredIsWarningsAlone) { EXPECT_EQ(said(), "quadloop: warning: a {} b\n"); }

TEST(Log, BracesAreNoFormat) { EXPECT_EQ(said({}), "quadloop: warning: a {} b\nquadloop: info: info\n"); }

TEST(Log, QuietLeavesWarnings) { EXPECT_EQ(said({0, 1, true, false}), "quadloop: warning: a {} b\n"); }

TEST(Log, TheRootSpeaksForAll) { EXPECT_EQ(said({1, 2, false, false}), ""); }

TEST(Log, VerboseIsEveryRankWithItsNumber) {
  EXPECT_EQ(said({0, 1, false, true}),
            "quadloop: warning: a {} b\nquadloop: info: info\nquadloop: debug: detail\n");
  EXPECT_EQ(said({1, 2, false, true}),
            "quadloop[1]: warning: a {} b\nquadloop[1]: info: info\nquadloop[1]: debug: detail\n");
}

TEST(Log, ASinkGetsEveryLineInsteadOfStderr) {
  std::vector<std::pair<log::Level, std::string>> lines;
  log::send_to([&](log::Level level, const std::string& line) { lines.emplace_back(level, line); });
  EXPECT_EQ(said(), "");
  log::send_to({});
  using enum log::Level;
  EXPECT_EQ(lines, (std::vector<std::pair<log::Level, std::string>>{
                       {warning, "a {} b"}, {information, "info"}, {detail, "detail"}}));
  EXPECT_NE(said(), "");
}

}  // namespace
}  // namespace quadloop
