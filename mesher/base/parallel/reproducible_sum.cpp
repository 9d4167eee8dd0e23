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
  double largest = 0;
  bool finite = true;
  for (const double value : values) {
    finite = finite && std::isfinite(value);
    largest = std::max(largest, std::abs(value));
  }
  if (comm.any(!finite)) return std::numeric_limits<double>::quiet_NaN();
  largest = comm.maximum(largest);
  if (largest == 0) return 0;
  ReproducibleSums sum(1, largest, comm.sum(std::ssize(values)));
  for (const double value : values) sum.add(0, value);
  return sum.over(comm).front();
}

}  // namespace quadloop
