#include "mesher/base/reproducible_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace quadloop {

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

  // Each value is high + low / 2^bits units of 2^(top - bits), and both parts of all of them fit into a 64-bit sum.
  const auto count = static_cast<std::uint64_t>(comm.sum(static_cast<std::int64_t>(values.size())));
  const int bits = 62 - static_cast<int>(std::bit_width(count)), top = std::ilogb(largest) + 1;
  std::int64_t high = 0, low = 0;
  for (const double value : values) {
    const double scaled = std::ldexp(value, bits - top), whole = std::nearbyint(scaled);
    high += static_cast<std::int64_t>(whole);
    low += static_cast<std::int64_t>(std::nearbyint(std::ldexp(scaled - whole, bits)));
  }
  high = comm.sum(high);
  low = comm.sum(low);
  return std::ldexp(static_cast<double>(high) + std::ldexp(static_cast<double>(low), -bits), top - bits);
}

}  // namespace quadloop
