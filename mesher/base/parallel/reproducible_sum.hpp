#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// Returns the sum of all ranks' values, bitwise independent of their order and of the number of ranks:
/// values are added as integers in a unit that depends on the largest value and the number of values. For up
/// to 2^31 values the error before the final rounding is less than 2^-60 times the largest absolute value
/// times the number of values. 0 for no values; NaN if any value is not finite. *Collective.*
double reproducible_sum(const Communicator& comm, std::span<const double> values);

/// Several such sums at once, of values with a known bound.
class ReproducibleSums {
 public:
  /// `sums` is the number of sums. Each has at most `count` values over all ranks, and no absolute value
  /// exceeds `largest`, which must be positive. The arguments are the same on every rank.
  ReproducibleSums(std::size_t sums, double largest, std::int64_t count);

  void add(std::size_t sum, double value) { add(sum, std::span(&value, 1)); }
  void add(std::size_t sum, std::span<const double> values) {
    std::int64_t high = 0, low = 0;
    for (const double value : values) {
      const double scaled = value * first_scale_ * second_scale_;
      const auto whole = static_cast<std::int64_t>(scaled);
      const double rest = (scaled - static_cast<double>(whole)) * parts_;
      high += whole;
      low += static_cast<std::int64_t>(rest + std::copysign(0.5, rest));
    }
    units_[2 * sum] += high;
    units_[2 * sum + 1] += low;
  }

  /// Returns the sums over all ranks. *Collective.*
  std::vector<double> over(const Communicator& comm) const;

 private:
  // Each value is high + low / 2^bits units of 2^(top - bits), and the sums of both parts fit into 64 bits.
  int bits_, top_;
  double first_scale_, second_scale_, parts_;
  std::vector<std::int64_t> units_;  ///< high part, then low part of each sum
};

}  // namespace quadloop
