// Makes the mistake that it is told to make.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace {

/// References to two temporaries, which are gone when they are read.
double dangling_reference(double x) {
  const auto [least, most] = std::minmax(std::abs(x), std::abs(x - 3));
  return most - least;
}

[[gnu::noinline]] const double& larger(double a, double b) {
  const double& first = a;  // so that no warning sees it
  return std::max(first, b);
}

int beyond_span(std::size_t i) {
  const std::vector<int> numbers{1, 2, 3};
  return std::span(numbers).first(2)[i];
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view mistake = argc > 1 ? argv[1] : "none";
  const auto nearly_one = static_cast<double>(argc) / 2;
  double result = 0;
  if (mistake == "dangling_reference") result = dangling_reference(nearly_one);
  if (mistake == "returned_reference") result = larger(nearly_one, 0.5);
  if (mistake == "beyond_span") result = beyond_span(static_cast<std::size_t>(argc));
  if (mistake == "overflow") result = std::numeric_limits<int>::max() - 1 + argc;
  if (mistake == "cast_of_nan")
    result =
        static_cast<double>(static_cast<std::int64_t>(nearly_one * std::numeric_limits<double>::quiet_NaN()));
  return std::isfinite(result) ? EXIT_SUCCESS : EXIT_FAILURE;
}
