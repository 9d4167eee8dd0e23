#include "mesher/base/parallel/reproducible_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace quadloop {

ReproducibleSums::ReproducibleSums(std::size_t sums, double largest, std::int64_t count)
    : bits_{62 - static_cast<int>(std::bit_width(static_cast<std::uint64_t>(count)))},
      top_{std::ilogb(largest) + 1},
      // 2^(bits - top) may overflow, so it is applied in two factors.
      first_scale_{std::ldexp(1, (bits_ - top_) / 2)},
      second_scale_{std::ldexp(1, bits_ - top_ - (bits_ - top_) / 2)},
      parts_{std::ldexp(1, bits_)},
      units_(2 * sums, 0) {}

namespace {

/// The largest absolute value; not finite if any value is not. The bits of positive numbers are in the order
/// of the numbers, and those of infinity and NaN come last.
double largest_size(std::span<const double> values) {
  constexpr std::uint64_t sign = std::uint64_t{1} << 63;
  std::uint64_t largest = 0;
  for (const double value : values) largest = std::max(largest, std::bit_cast<std::uint64_t>(value) & ~sign);
  return std::bit_cast<double>(largest);
}

}  // namespace

std::vector<double> ReproducibleSums::over(const Communicator& comm) const {
  const std::vector<std::int64_t> units = comm.sum(units_);
  std::vector<double> sums;
  for (std::size_t k = 0; k < units.size(); k += 2) {
    const auto high = static_cast<double>(units[k]), low = static_cast<double>(units[k + 1]);
    sums.push_back(std::ldexp(high + std::ldexp(low, -bits_), top_ - bits_));
  }
  return sums;
}

double reproducible_sum(const Communicator& comm, std::span<const double> values) {
  double largest = largest_size(values);
  if (comm.any(!std::isfinite(largest))) return std::numeric_limits<double>::quiet_NaN();
  largest = comm.maximum(largest);
  if (largest == 0) return 0;
  ReproducibleSums sum(1, largest, comm.sum(std::ssize(values)));
  sum.add(0, values);
  return sum.over(comm).front();
}

}  // namespace quadloop
