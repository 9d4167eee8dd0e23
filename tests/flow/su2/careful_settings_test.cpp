// Lower CFL numbers for a second run of SU2.
#include "flow/su2/careful_settings.hpp"

#include <gtest/gtest.h>

namespace quadloop::flow {
namespace {

std::string careful(const std::string& text) {
  Su2Config config(text, "flow.cfg");
  set_careful_cfl(config);
  return config.text();
}

TEST(CarefulSettings, AreATenthOfTheCflNumbersWithASlowerRamp) {
  EXPECT_EQ(careful("CFL_NUMBER= 20\nCFL_ADAPT= YES\nCFL_ADAPT_PARAM= ( 0.5, 1.04, 10, 1e4, 0.3 )\n"),
            "CFL_NUMBER= 2\nCFL_ADAPT= YES\nCFL_ADAPT_PARAM= ( 0.5, 1.02, 1, 1000, 0.3 )\n");
}

TEST(CarefulSettings, BeginAtTheDefaultOfSu2) {
  EXPECT_EQ(careful("ITER= 10\n"), "ITER= 10\nCFL_NUMBER= 0.125\n");
}

TEST(CarefulSettings, KeepWhatIsNoNumber) {
  EXPECT_EQ(careful("CFL_NUMBER= much\nCFL_ADAPT_PARAM= ( 0.5, x )\n"),
            "CFL_NUMBER= much\nCFL_ADAPT_PARAM= ( 0.5, x )\n");
}

}  // namespace
}  // namespace quadloop::flow
