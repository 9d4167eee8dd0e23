#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// All ranks' indicators of leaves with cells, in ascending order, to ask for the k-th. Nothing here depends
/// on the order or the ranks of the leaves. Time and memory n log n for this rank's leaves; each question
/// costs at most 64 short rounds over all ranks.
class OrderedValues {
 public:
  /// Values are finite and not negative, one for each leaf of this rank's share. *Collective.*
  OrderedValues(const Communicator& comm, std::span<const LeafRecord> leaves, std::span<const double> values);

  std::span<const double> own() const { return own_; }  ///< this rank's
  std::int64_t count() const { return count_; }         ///< over all ranks
  double smallest() const { return smallest_; }         ///< over all ranks; 0 where there is none
  double largest() const { return largest_; }

  /// The smallest value v so that at least k (1 to count()) values are no larger than v: the k-th smallest.
  /// *Collective.*
  double kth_smallest(std::int64_t k) const;
  double kth_largest(std::int64_t k) const { return kth_smallest(count_ + 1 - k); }

  /// The threshold above which that share (0 to 1) of the leaves lies, to the nearest count: all that are as
  /// large as the last of them lie above it too, so equal leaves are treated alike; but none with an
  /// indicator of 0. It never rises with the share, and marks nothing for a share of 0. *Collective.*
  double refine_threshold(double share) const;
  /// The threshold below which that share of the leaves lies, to the nearest count, and all that are as small
  /// as the last of them. It never falls with the share, and marks nothing for a share of 0. *Collective.*
  double coarsen_threshold(double share) const;

 private:
  std::int64_t count_of_share(double share) const;

  const Communicator* comm_;
  std::vector<double> own_;
  std::int64_t count_ = 0;
  double smallest_ = 0, largest_ = 0;
};

}  // namespace quadloop
