#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::adapt {

/// Two partitions of one global row of cells among the ranks, each with one contiguous part per rank in rank
/// order. Moves values from one partition to the other.
class CellShare {
 public:
  /// This rank has `held` cells of the row and needs `wanted` cells. *Collective.*
  CellShare(const Communicator& comm, std::int64_t held, std::int64_t wanted);

  std::int64_t all_held() const { return first_held_.back(); }
  std::int64_t all_wanted() const { return first_wanted_.back(); }

  /// Converts one value per held cell to one value per wanted cell, in order. Both partitions must have the
  /// same total length. *Collective.*
  std::vector<double> bring(const Communicator& comm, std::span<const double> held) const;

 private:
  std::vector<std::int64_t> first_held_, first_wanted_;  ///< for each rank, then the total
};

}  // namespace quadloop::adapt
