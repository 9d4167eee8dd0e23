#include "mesher/base/parallel/kth_smallest.hpp"

#include <algorithm>
#include <bit>
#include <iterator>
#include <limits>

namespace quadloop {

double kth_smallest(const Communicator& comm, std::vector<double>& values, std::int64_t k) {
  // Of each rank only as many of its largest values matter as there are from the k-th on over all ranks.
  const std::int64_t from_kth = comm.sum(std::ssize(values)) - k + 1;
  const std::int64_t below = std::max<std::int64_t>(0, std::ssize(values) - from_kth);
  const auto begin = values.begin() + below;
  if (below > 0) std::nth_element(values.begin(), begin, values.end());
  std::sort(begin, values.end());
  std::uint64_t low = 0, high = std::bit_cast<std::uint64_t>(std::numeric_limits<double>::infinity());
  while (low < high) {  // numbers that are not negative are ordered as their bits
    const std::uint64_t middle = low + (high - low) / 2;
    const auto end = std::upper_bound(begin, values.end(), std::bit_cast<double>(middle));
    if (comm.sum(end - values.begin()) >= k)
      high = middle;
    else
      low = middle + 1;
  }
  return std::bit_cast<double>(low);
}

}  // namespace quadloop
