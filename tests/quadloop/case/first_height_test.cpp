#include "quadloop/case/first_height.hpp"

#include <gtest/gtest.h>

namespace quadloop {
namespace {

TEST(HeightOfYPlus, IsThatOfAFlatPlateBySchlichting) {
  // cf = (2 log10 6e6 - 0.65)^-2.3 = 0.00278712, u_tau = 0.0373304 U
  EXPECT_NEAR(height_of_y_plus(1, {6e6, 1}), 4.464634e-6, 1e-12);
  EXPECT_NEAR(height_of_y_plus(1, {5000, 1}), 2.541510e-3, 1e-9);
  EXPECT_DOUBLE_EQ(height_of_y_plus(30, {6e6, 2}), 60 * height_of_y_plus(1, {6e6, 1}));
}

}  // namespace
}  // namespace quadloop
