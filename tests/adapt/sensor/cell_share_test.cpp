// One row of values, spread in two ways.
#include "adapt/sensor/cell_share.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "mesher/base/error.hpp"
#include "tests/adapt/sensor/shared_leaves.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::Sharing, test::world;

TEST(CellShare, BringsEachValueToItsPlace) {
  std::vector<double> all(47);
  std::iota(all.begin(), all.end(), 100);
  for (const Sharing from : test::all_sharings) {
    for (const Sharing to : test::all_sharings) {
      const auto held = test::share_of(all, from), wanted = test::share_of(all, to);
      const CellShare share(world(), std::ssize(held), std::ssize(wanted));
      EXPECT_EQ(share.all_held(), 47);
      EXPECT_EQ(share.all_wanted(), 47);
      EXPECT_EQ(share.bring(world(), held), wanted);
    }
  }
}

TEST(CellShare, OfFewerCellsThanRanksAndOfNone) {
  for (const std::size_t count : {0U, 1U}) {
    const std::vector<double> all(count, 7.5);
    const auto held = test::share_of(all, Sharing::even), wanted = test::share_of(all, Sharing::last_rank);
    EXPECT_EQ(CellShare(world(), std::ssize(held), std::ssize(wanted)).bring(world(), held), wanted);
  }
}

TEST(CellShare, RowsThatDoNotFitAreRefused) {
  const std::vector<double> held(3);
  const CellShare share(world(), 3, world().is_root() ? 5 : 0);
  EXPECT_NE(share.all_held(), share.all_wanted());
  EXPECT_THROW(share.bring(world(), held), Fault);
  EXPECT_THROW(CellShare(world(), 4, 4).bring(world(), held), Fault);
}

}  // namespace
}  // namespace quadloop::adapt
