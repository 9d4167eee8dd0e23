// Whatever the processor's vectors, the same bits.
#include "smoother/objective/star_kernels.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "tests/smoother/stars.hpp"

namespace quadloop::smoother {
namespace {

using test::Cells;
using test::Random;
using test::uniform;

constexpr int places = StarKernels::batch;

/// Bits, so that -0 is not 0, nor any two that are not numbers different.
std::uint64_t bits(double value) {
  return std::isnan(value) ? std::bit_cast<std::uint64_t>(std::numeric_limits<double>::quiet_NaN())
                           : std::bit_cast<std::uint64_t>(value);
}

std::vector<std::uint64_t> bits_of(const StarDerivatives& d) {
  std::vector<std::uint64_t> all;
  for (const double value : {d.squares, d.cubes, d.defects, d.cotangents, d.soundness, d.gradient.x,
                             d.gradient.y, d.xx, d.xy, d.yy, d.edges})
    all.push_back(bits(value));
  return all;
}

template <int count>
std::vector<std::uint64_t> bits_of(const StarSums<count>& sums, std::size_t place) {
  std::vector<std::uint64_t> all;
  for (const auto* values : {&sums.costs, &sums.squares, &sums.defects, &sums.cotangents, &sums.soundness})
    all.push_back(bits((*values)[place]));
  return all;
}

/// Calls `check(corners, x, y)` with stars of many sizes and places in and round them.
template <class Check>
void for_each_case(const Check& check) {
  Random random(5);
  for (int i = 0; i < 600; ++i) {
    const auto cells = std::array{Cells::triangles, Cells::quads, Cells::mixed}[i % 3];
    std::vector<StarCorner> corners = test::random_star(random, cells, i % 2 == 1).corners();
    corners.resize(1 + i / 3 % corners.size());
    std::array<double, places> x, y;
    for (std::size_t k = 0; k < places; ++k) {
      x[k] = uniform(random, -0.4, 0.4);
      y[k] = uniform(random, -0.4, 0.4);
    }
    check(corners, x, y);
  }
}

TEST(StarKernels, OfAllVectorsGiveTheSameBits) {
  const std::vector<StarKernels> kernels = star_kernels();
  for_each_case([&](const auto& corners, const auto& x, const auto& y) {
    const auto sums = kernels[0].sums(corners, x.data(), y.data());
    for (const StarKernels& others : kernels) {
      const auto other_sums = others.sums(corners, x.data(), y.data());
      for (std::size_t k = 0; k < places; ++k) {
        EXPECT_EQ(bits_of(other_sums, k), bits_of(sums, k));
        EXPECT_EQ(bits_of(others.derivatives(corners, {x[k], y[k]})),
                  bits_of(kernels[0].derivatives(corners, {x[k], y[k]})));
      }
    }
  });
}

TEST(StarKernels, AreTheSumsPlaceByPlace) {
  for_each_case([](const auto& corners, const auto& x, const auto& y) {
    for (const StarKernels& kernels : star_kernels()) {
      const auto sums = kernels.sums(corners, x.data(), y.data());
      for (std::size_t k = 0; k < places; ++k) {
        const auto one = star_sums(corners, {x[k], y[k]});
        EXPECT_EQ(bits_of(sums, k), bits_of(one, 0));
        const StarDerivatives d = kernels.derivatives(corners, {x[k], y[k]});
        EXPECT_EQ(bits(d.squares), bits(one.squares[0]));
        EXPECT_EQ(bits(d.soundness), bits(one.soundness[0]));
        if (one.soundness[0] <= 0) continue;  // these are of no use where a corner is inverted
        EXPECT_EQ(bits(d.defects), bits(one.defects[0]));
        EXPECT_EQ(bits(d.cotangents), bits(one.cotangents[0]));
      }
    }
  });
}

/// So that the test above compares something: this runs where there is AVX2, as on any processor of the last
/// ten years.
TEST(StarKernels, AreThereForThisProcessor) {
#ifdef __x86_64__
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2";
  EXPECT_GE(star_kernels().size(), 2U);
#else
  EXPECT_EQ(star_kernels().size(), 1U);
#endif
}

}  // namespace
}  // namespace quadloop::smoother
