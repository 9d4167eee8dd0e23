#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/forest/curve_owners.hpp"

namespace quadloop {

/// A leaf of another rank that touches one of this rank's leaves by an edge or a corner.
struct Ghost {
  Quadrant quadrant;
  int owner = 0;
  std::int32_t index = 0;  ///< its local index on its owner
};

/// All ghost leaves, in the order of the curve. `leaves` are this rank's. Visits only quadrants at the border
/// of this rank's part, so that the work grows with the border and not with the number of leaves.
/// *Collective.*
std::vector<Ghost> ghost_layer(const Communicator& comm, const TreeGrid& grid, const CurveOwners& owners,
                               std::span<const Quadrant> leaves);

}  // namespace quadloop
