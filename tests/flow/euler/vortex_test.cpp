// A vortex that drifts is kept to second order; vortex_order_test does the same on finer meshes.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/flow/euler/vortex_error.hpp"

namespace quadloop::flow {
namespace {

#ifdef QUADLOOP_FINE
constexpr std::array<std::int32_t, 3> sizes{40, 80, 160};
#else
constexpr std::array<std::int32_t, 2> sizes{40, 80};
#endif

double order(EulerOptions::Limiter limiter, bool quads) {
  const double before = test::vortex_error(sizes[sizes.size() - 2], limiter, quads),
               after = test::vortex_error(sizes.back(), limiter, quads);
  testing::Test::RecordProperty("error", std::to_string(after));
  return std::log2(before / after);
}

TEST(Vortex, IsKeptToSecondOrderWithoutLimiter) {
  for (const bool quads : {true, false}) EXPECT_GE(order(EulerOptions::Limiter::none, quads), 1.8) << quads;
}

TEST(Vortex, IsKeptWithTheLimiterToo) {
  for (const bool quads : {true, false})
    EXPECT_GE(order(EulerOptions::Limiter::venkatakrishnan, quads), 1.5) << quads;
}

}  // namespace
}  // namespace quadloop::flow
