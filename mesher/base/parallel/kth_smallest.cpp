#include "mesher/base/parallel/kth_smallest.hpp"

#include <algorithm>
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
  return kth_smallest(0, std::numeric_limits<double>::infinity(), k, [&](double bound) {
    return comm.sum(std::upper_bound(begin, values.end(), bound) - values.begin());
  });
}

}  // namespace quadloop
