#include "adapt/sensor/ordered_values.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/kth_smallest.hpp"

namespace quadloop::adapt {

namespace {

/// Non-negative values are ordered like their bit patterns; the upper bits (exponent and four digits of the
/// mantissa) select the part.
std::size_t part_of(double value) { return std::bit_cast<std::uint64_t>(value) >> 48; }
constexpr std::size_t parts = std::size_t{1} << 15;

}  // namespace

OrderedValues::OrderedValues(const Communicator& comm, std::span<const LeafRecord> leaves,
                             std::span<const double> values)
    : comm_{&comm} {
  std::vector<double> unordered;
  unordered.reserve(values.size());
  comm.together([&] {
    QUADLOOP_REQUIRE(leaves.size() == values.size(), "there must be one indicator for each leaf",
                     leaves.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!has_cells(leaves[i])) continue;
      QUADLOOP_REQUIRE(std::isfinite(values[i]) && values[i] >= 0,
                       "an indicator must be finite and not negative");
      unordered.push_back(values[i] + 0.0);  // -0 becomes 0, so that its bits are in order with the others
    }
  });
  put_into_parts(unordered);
  count_ = comm.sum(std::ssize(own_));
  if (count_ == 0) return;
  const auto [least, most] = std::ranges::minmax_element(own_);
  smallest_ = comm.minimum(own_.empty() ? std::numeric_limits<double>::infinity() : *least);
  largest_ = comm.maximum(own_.empty() ? 0 : *most);
}

void OrderedValues::put_into_parts(std::span<const double> values) {
  begins_.assign(parts + 1, 0);
  sorted_.assign(parts, 0);
  for (const double value : values) ++begins_[part_of(value) + 1];
  std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
  std::vector<std::int64_t> next(begins_.begin(), begins_.end() - 1);
  own_.resize(values.size());
  for (const double value : values) own_[next[part_of(value)]++] = value;
}

std::int64_t OrderedValues::count_up_to(double bound) const {
  const std::size_t part = part_of(bound);
  const auto begin = own_.begin() + begins_[part], end = own_.begin() + begins_[part + 1];
  if (sorted_[part] == 0) std::sort(begin, end);
  sorted_[part] = 1;
  return std::upper_bound(begin, end, bound) - own_.begin();
}

double OrderedValues::kth_smallest(std::int64_t k) const {
  QUADLOOP_REQUIRE(1 <= k && k <= count_, "there is no such value", k, count_);
  return quadloop::kth_smallest(smallest_, largest_, k,
                                [&](double bound) { return comm_->sum(count_up_to(bound)); });
}

std::int64_t OrderedValues::count_of_share(double share) const {
  QUADLOOP_REQUIRE(0 <= share && share <= 1, "a share must be from 0 to 1", share);
  return std::llround(share * static_cast<double>(count_));
}

double OrderedValues::refine_threshold(double share) const {
  const std::int64_t k = count_of_share(share);
  if (k == 0) return std::numeric_limits<double>::infinity();
  return std::nextafter(kth_largest(k), 0);  // 0 if the k-th largest is 0; no 0 is above it
}

double OrderedValues::coarsen_threshold(double share) const {
  const std::int64_t k = count_of_share(share);
  return k == 0 ? 0 : std::nextafter(kth_smallest(k), std::numeric_limits<double>::infinity());
}

}  // namespace quadloop::adapt
