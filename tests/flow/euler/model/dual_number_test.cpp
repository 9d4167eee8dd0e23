#include "flow/euler/model/dual_number.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace quadloop::flow::euler {
namespace {

using Dual = DualNumber<2>;

TEST(DualNumbers, CarryDerivatives) {
  const Dual x = Dual::variable(3, 0), y = Dual::variable(-2, 1);
  const Dual f = sqrt(x * x + 4 * y * y) / (1 - y) + abs(y) * x - 2;
  const double root = 5;
  EXPECT_DOUBLE_EQ(f.value, root / 3 + 6 - 2);
  EXPECT_DOUBLE_EQ(f.slopes[0], 3 / root / 3 + 2);
  EXPECT_DOUBLE_EQ(f.slopes[1], 4 * -2 / root / 3 + root / 9 - 3);
}

TEST(DualNumbers, FollowTheBranchTaken) {
  const Dual x = Dual::variable(3, 0), y = Dual::variable(-2, 1);
  EXPECT_EQ(std::max<Dual>(x, y * y).slopes[1], -4);
  EXPECT_EQ(std::min<Dual>(x, 1.0).slopes[0], 0);
  EXPECT_TRUE(y < x && x > y && x <= 3.0 && y >= -2.0 && !(x < y));
}

}  // namespace
}  // namespace quadloop::flow::euler
