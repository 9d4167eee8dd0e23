#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// Returns the k-th smallest of values between `low` and `high`, which are not negative: the smallest number
/// of which `count_up_to(number)`, the number of values on all ranks that are not larger, is at least k. At
/// most 64 calls. *Collective* if `count_up_to` is.
template <class CountUpTo>
double kth_smallest(double low, double high, std::int64_t k, const CountUpTo& count_up_to) {
  // The bits of such numbers are integers in the same order, so halving an interval of them ends at the
  // value.
  auto from = std::bit_cast<std::uint64_t>(low), to = std::bit_cast<std::uint64_t>(high);
  while (from < to) {
    const std::uint64_t middle = from + (to - from) / 2;
    if (count_up_to(std::bit_cast<double>(middle)) >= k)
      to = middle;
    else
      from = middle + 1;
  }
  return std::bit_cast<double>(from);
}

/// Returns the k-th smallest of all ranks' values, k from 1 to their number; values must not be negative. The
/// values of a rank are reordered; nothing but counts is exchanged. *Collective.*
double kth_smallest(const Communicator& comm, std::vector<double>& values, std::int64_t k);

}  // namespace quadloop
