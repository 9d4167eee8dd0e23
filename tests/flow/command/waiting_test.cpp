// Ranks that wait for a long time leave the processors alone.
#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <thread>

#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

TEST(PatientBarrier, HoldsAllRanksAndCostsNoTime) {
  world().barrier();
  const auto begin = std::chrono::steady_clock::now();
  const std::clock_t used_before = std::clock();
  if (world().is_root()) std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  world().patient_barrier();
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
  const double used = static_cast<double>(std::clock() - used_before) / CLOCKS_PER_SEC;
  EXPECT_GT(waited.count(), 1.4);
  EXPECT_LT(used, 0.3);
}

TEST(PatientBarrier, ComesThroughSoon) {
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 20; ++i) world().patient_barrier();
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - begin;
  EXPECT_LT(waited.count(), 5);
}

}  // namespace
}  // namespace quadloop
