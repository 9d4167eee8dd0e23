#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// The sum of all ranks' values, with the same bits whatever the order of the values and the number of ranks:
/// values are added as integers that count a unit set by the largest of them and by how many there are. Off
/// by less than 2^-60 of the largest value's size times their number for up to 2^31 values, beside the
/// rounding of the result. 0 for no values; not a number where any value is not finite. *Collective.*
double reproducible_sum(const Communicator& comm, std::span<const double> values);

/// Many such sums at once, of values whose largest size is known beforehand.
class ReproducibleSums {
 public:
  /// Each of `sums` sums is of at most `count` values over all ranks, none larger than `largest`, which is
  /// above 0; the same on every rank.
  ReproducibleSums(std::size_t sums, double largest, std::int64_t count);

  void add(std::size_t sum, double value) {
    const double scaled = value * first_scale_ * second_scale_;
    const auto whole = static_cast<std::int64_t>(scaled);
    const double rest = (scaled - static_cast<double>(whole)) * parts_;
    units_[2 * sum] += whole;
    units_[2 * sum + 1] += static_cast<std::int64_t>(rest + std::copysign(0.5, rest));
  }

  /// Over all ranks. *Collective.*
  std::vector<double> over(const Communicator& comm) const;

 private:
  // Each value is high + low / 2^bits units of 2^(top - bits), and both parts of all of them fit into a
  // 64-bit sum.
  int bits_, top_;
  double first_scale_, second_scale_, parts_;
  std::vector<std::int64_t> units_;  ///< of each sum the high part, then the low one
};

}  // namespace quadloop
