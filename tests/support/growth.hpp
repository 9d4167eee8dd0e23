#pragma once

#include <gtest/gtest.h>

#include <ctime>
#include <functional>
#include <string>

namespace quadloop::test {

inline double processor_seconds(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

/// Eight times as many may take twenty times as long, where the square would be 64.
inline void expect_linear(const std::string& what, double few, double many) {
  EXPECT_LT(many, 20 * few + 0.2) << what << ": " << few << " s, then " << many << " s";
}

/// The processor time of `work(number)` grows with the number and not with its square. `few` is large enough
/// for the square of eight times as many to show.
inline void expect_linear(const std::string& what, int few, const std::function<void(int)>& work) {
  const double of_few = processor_seconds([&] { work(few); });
  expect_linear(what, of_few, processor_seconds([&] { work(8 * few); }));
}

}  // namespace quadloop::test
