#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// Two ways to spread one global row of cells over the ranks, each giving every rank one piece, in the order
/// of ranks. Takes values from the one to the other, wherever the pieces meet.
class CellShare {
 public:
  /// This rank has `held` cells of the row and wants `wanted`. *Collective.*
  CellShare(const Communicator& comm, std::int64_t held, std::int64_t wanted);

  std::int64_t all_held() const { return first_held_.back(); }
  std::int64_t all_wanted() const { return first_wanted_.back(); }

  /// One value for each cell held becomes one for each cell wanted, in their order. Both rows must be equally
  /// long. *Collective.*
  std::vector<double> bring(const Communicator& comm, std::span<const double> held) const;

 private:
  std::vector<std::int64_t> first_held_, first_wanted_;  ///< of each rank, and the number of all
};

}  // namespace quadloop
