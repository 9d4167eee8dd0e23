#include "mesher/base/parallel/reproducible_sum.hpp"

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

  // Each value is high + low / 2^bits units of 2^(top - bits), and both parts of all of them fit into a
  // 64-bit sum.
  const std::uint64_t count = comm.sum(std::ssize(values));
  const int bits = 62 - static_cast<int>(std::bit_width(count)), top = std::ilogb(largest) + 1;
  // 2^(bits - top) may be too large for a number: in two steps.
  const double first_scale = std::ldexp(1, (bits - top) / 2),
               second_scale = std::ldexp(1, bits - top - (bits - top) / 2), parts = std::ldexp(1, bits);
  std::int64_t high = 0, low = 0;
  for (const double value : values) {
    const double scaled = value * first_scale * second_scale;
    const auto whole = static_cast<std::int64_t>(scaled);
    const double rest = (scaled - static_cast<double>(whole)) * parts;
    high += whole;
    low += static_cast<std::int64_t>(rest + std::copysign(0.5, rest));
  }
  high = comm.sum(high);
  low = comm.sum(low);
  return std::ldexp(static_cast<double>(high) + std::ldexp(static_cast<double>(low), -bits), top - bits);
}

}  // namespace quadloop
