#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// All ranks' indicators of leaves with cells, to ask for the k-th of them in ascending order. Nothing here
/// depends on the order or the ranks of the leaves. Parts of near values follow each other; one is sorted
/// where a question falls into it. Each question costs at most 64 short rounds over all ranks.
class OrderedValues {
 public:
  /// Values are finite and not negative, one for each leaf of this rank's share. *Collective.*
  OrderedValues(const Communicator& comm, std::span<const LeafRecord> leaves, std::span<const double> values);

  std::span<const double> own() const { return own_; }  ///< this rank's, in no order
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

  void put_into_parts(std::span<const double> values);
  /// This rank's that are no larger; `bound` is finite and not negative.
  std::int64_t count_up_to(double bound) const;

  const Communicator* comm_;
  mutable std::vector<double> own_;   ///< part by part
  mutable std::vector<char> sorted_;  ///< of each part, whether it is
  std::vector<std::int64_t> begins_;  ///< of each part in own_, and the end
  std::int64_t count_ = 0;
  double smallest_ = 0, largest_ = 0;
};

}  // namespace quadloop
