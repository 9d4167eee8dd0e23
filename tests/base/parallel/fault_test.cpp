// What a broken requirement says.
#include <gtest/gtest.h>

#include "mesher/base/error.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

std::string fault_of(const auto& broken) {
  try {
    broken();
  } catch (const Fault& fault) {
    const std::string what = fault.what();
    return what.substr(what.find(": ") + 2);
  }
  return "";
}

std::string rank_alone() {
  const std::string rank = std::to_string(test::world().rank()), size = std::to_string(test::world().size());
  return test::world().size() == 1 ? "" : "rank " + rank + " of " + size;
}

TEST(Require, SaysNamesAndValuesAndTheRank) {
  const std::vector<int> rows{1, 2, 3};
  const std::string name = "Mach";
  const auto at = [](int i, int j) { return i + j / 2.0; };
  const std::string rank = rank_alone().empty() ? "" : ", " + rank_alone();
  EXPECT_EQ(fault_of([&] { QUADLOOP_REQUIRE(rows.size() == 2, "two rows", rows.size(), at(4, 1), name); }),
            "two rows (rows.size() = 3, at(4, 1) = 4.500000, name = Mach" + rank + ")");
}

TEST(Require, NeedsNoValues) {
  EXPECT_EQ(fault_of([] { QUADLOOP_REQUIRE(false, "nothing"); }),
            rank_alone().empty() ? "nothing" : "nothing (" + rank_alone() + ")");
}

TEST(Require, LooksAtNoValueWhereItHolds) {
  int looks = 0;
  const auto look = [&] { return ++looks; };
  QUADLOOP_REQUIRE(looks == 0, "no look", look());
  EXPECT_EQ(looks, 0);
}

}  // namespace
}  // namespace quadloop
