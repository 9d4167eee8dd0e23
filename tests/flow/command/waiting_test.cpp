// Ranks that wait for a long time leave the processors alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <ctime>
#include <thread>

#include "tests/support/world.hpp"

namespace quadloop::flow {
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

/// Seconds that some barriers take.
double seconds_of(int barriers) {
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < barriers; ++i) world().patient_barrier();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

TEST(PatientBarrier, ComesThroughSoon) {
  const int doublings = std::bit_width(static_cast<unsigned>(world().size()) - 1);
  double least = 1e9;  // of some attempts: the machine may be busy
  for (int attempt = 0; attempt < 5; ++attempt) least = std::min(least, seconds_of(20));
  EXPECT_LT(least, 20 * 0.01 * doublings + 0.05);
}

}  // namespace
}  // namespace quadloop::flow
