#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop::adapt {

/// All ranks' indicators of leaves with cells, for queries of the k-th smallest. Results do not depend on the
/// order or the partition of the leaves. Values are kept in parts of similar values; a part is sorted when a
/// query needs it. Each query costs at most 64 short rounds of communication.
class OrderedValues {
 public:
  /// Values must be finite and not negative, one per local leaf. *Collective.*
  OrderedValues(const Communicator& comm, std::span<const LeafRecord> leaves, std::span<const double> values);

  std::span<const double> own() const { return own_; }  ///< this rank's values, unordered
  std::int64_t count() const { return count_; }         ///< over all ranks
  double smallest() const { return smallest_; }         ///< over all ranks; 0 if there is none
  double largest() const { return largest_; }

  /// The k-th smallest value: the smallest v such that at least k (1 to count()) values are not larger than
  /// v. *Collective.*
  double kth_smallest(std::int64_t k) const;
  double kth_largest(std::int64_t k) const { return kth_smallest(count_ + 1 - k); }

  /// The threshold above which the fraction `share` (0 to 1) of the leaves lies, to the nearest count. Leaves
  /// equal to the last of them are included, so that equal leaves are treated alike; leaves with indicator 0
  /// are excluded. Does not increase with the share; marks nothing for a share of 0. *Collective.*
  double refine_threshold(double share) const;
  /// The threshold below which that fraction of the leaves lies, to the nearest count, including all leaves
  /// equal to the last of them. Does not decrease with the share; marks nothing for a share of 0.
  /// *Collective.*
  double coarsen_threshold(double share) const;

 private:
  std::int64_t count_of_share(double share) const;

  void put_into_parts(std::span<const double> values);
  /// Number of this rank's values that are at most `bound`, which is finite and not negative.
  std::int64_t count_up_to(double bound) const;

  const Communicator* comm_;
  mutable std::vector<double> own_;   ///< part by part
  mutable std::vector<char> sorted_;  ///< for each part whether it is sorted
  std::vector<std::int64_t> begins_;  ///< of each part in own_, then the end
  std::int64_t count_ = 0;
  double smallest_ = 0, largest_ = 0;
};

}  // namespace quadloop::adapt
