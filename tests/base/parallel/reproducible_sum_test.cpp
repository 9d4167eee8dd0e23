// The sum over ranks is right, and the same bits in any order and on any number of ranks.
#include "mesher/base/parallel/reproducible_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// This rank's share of the values.
std::vector<double> share_of(const std::vector<double>& values) {
  std::vector<double> share;
  for (std::size_t i = static_cast<std::size_t>(world().rank()); i < values.size();
       i += static_cast<std::size_t>(world().size()))
    share.push_back(values[i]);
  return share;
}

std::vector<double> random_values(int exponent_range) {
  std::mt19937_64 random(7);
  std::vector<double> values;
  for (int i = 0; i < 5000; ++i) {
    const double mantissa = static_cast<double>(random() >> 11) * 0x1p-52 - 1;
    values.push_back(std::ldexp(
        mantissa,
        static_cast<int>(random() % static_cast<std::uint64_t>(exponent_range)) - exponent_range / 2));
  }
  return values;
}

TEST(ReproducibleSum, IsTheSumOfIntegers) {
  std::vector<double> values;
  for (int i = 1; i <= 1000; ++i) values.push_back(i);
  EXPECT_EQ(reproducible_sum(world(), share_of(values)), 500500);
}

TEST(ReproducibleSum, DependsOnNeitherOrderNorRanks) {
  std::vector<double> values = random_values(60);
  const double sum = reproducible_sum(world(), share_of(values));
  std::shuffle(values.begin(), values.end(), std::mt19937_64(3));
  EXPECT_EQ(reproducible_sum(world(), share_of(values)), sum);
  const Communicator alone(MPI_COMM_SELF);
  EXPECT_EQ(reproducible_sum(alone, values), sum);
}

TEST(ReproducibleSum, IsAsNearAsLongDouble) {
  const std::vector<double> values = random_values(20);
  long double sum = 0;
  for (const double value : values) sum += value;
  EXPECT_NEAR(reproducible_sum(world(), share_of(values)), static_cast<double>(sum),
              1e-14 * std::abs(static_cast<double>(sum)) + 1e-12);
}

TEST(ReproducibleSum, KeepsWhatCancels) {
  EXPECT_EQ(reproducible_sum(world(), share_of({1e16, 1, -1e16, 1})), 2);
  const double smallest = std::numeric_limits<double>::denorm_min(),
               largest = std::numeric_limits<double>::max();
  EXPECT_EQ(reproducible_sum(world(), share_of({smallest, smallest})), 2 * smallest);
  EXPECT_EQ(reproducible_sum(world(), share_of({largest, -largest, largest / 2})), largest / 2);
}

TEST(ReproducibleSum, OfNothingIsZeroAndOfNonsenseIsNot) {
  EXPECT_EQ(reproducible_sum(world(), {}), 0);
  EXPECT_TRUE(std::isnan(reproducible_sum(world(), share_of({1, std::numeric_limits<double>::infinity()}))));
}

TEST(ReproducibleSums, AreThoseOfEachAlone) {
  const std::vector<double> values = random_values(20);
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  const auto sums = [&](const Communicator& comm, const std::vector<double>& share) {
    ReproducibleSums all(3, 2 * largest, std::ssize(values));
    for (const double value : share) {
      all.add(0, value);
      all.add(2, -2 * value);
    }
    return all.over(comm);
  };
  const std::vector<double> own = share_of(values), found = sums(world(), own);
  EXPECT_NEAR(found[0], reproducible_sum(world(), own), 1e-15 * largest * static_cast<double>(values.size()));
  EXPECT_EQ(found[1], 0);
  EXPECT_EQ(found[2], -2 * found[0]);
  const Communicator alone(MPI_COMM_SELF);
  EXPECT_EQ(sums(alone, values), found);
}

}  // namespace
}  // namespace quadloop
