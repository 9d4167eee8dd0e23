#include "adapt/sensor/ordered_values.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "mesher/base/error.hpp"

namespace quadloop {

OrderedValues::OrderedValues(const Communicator& comm, std::span<const LeafRecord> leaves,
                             std::span<const double> values)
    : comm_{&comm} {
  comm.together([&] {
    QUADLOOP_REQUIRE(leaves.size() == values.size(), "there must be one indicator for each leaf");
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!has_cells(leaves[i])) continue;
      QUADLOOP_REQUIRE(std::isfinite(values[i]) && values[i] >= 0,
                       "an indicator must be finite and not negative");
      own_.push_back(values[i] + 0.0);  // -0 becomes 0, whose bits are in order with the others
    }
  });
  std::sort(own_.begin(), own_.end());
  count_ = comm.sum(std::ssize(own_));
  if (count_ == 0) return;
  smallest_ = comm.minimum(own_.empty() ? std::numeric_limits<double>::infinity() : own_.front());
  largest_ = comm.maximum(own_.empty() ? 0 : own_.back());
}

double OrderedValues::kth_smallest(std::int64_t k) const {
  QUADLOOP_REQUIRE(1 <= k && k <= count_, "there is no such value");
  // The bits of doubles that are not negative are integers in the same order, so halving an interval of them
  // ends at the very value.
  auto low = std::bit_cast<std::uint64_t>(smallest_), high = std::bit_cast<std::uint64_t>(largest_);
  while (low < high) {
    const std::uint64_t middle = low + (high - low) / 2;
    const auto last = std::upper_bound(own_.begin(), own_.end(), std::bit_cast<double>(middle));
    if (comm_->sum(last - own_.begin()) >= k) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  return std::bit_cast<double>(low);
}

std::int64_t OrderedValues::count_of_share(double share) const {
  QUADLOOP_REQUIRE(0 <= share && share <= 1, "a share must be from 0 to 1");
  return std::llround(share * static_cast<double>(count_));
}

double OrderedValues::refine_threshold(double share) const {
  const std::int64_t k = count_of_share(share);
  if (k == 0) return std::numeric_limits<double>::infinity();
  return std::nextafter(kth_largest(k), 0);  // of 0 it is 0 itself, above which no 0 lies
}

double OrderedValues::coarsen_threshold(double share) const {
  const std::int64_t k = count_of_share(share);
  return k == 0 ? 0 : std::nextafter(kth_smallest(k), std::numeric_limits<double>::infinity());
}

}  // namespace quadloop
