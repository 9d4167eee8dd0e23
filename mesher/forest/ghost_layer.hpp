#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/forest/curve_owners.hpp"

namespace quadloop {

/// A leaf of another rank that touches one of this rank's, by an edge or a corner.
struct Ghost {
  Quadrant quadrant;
  int owner = 0;
  std::int32_t index = 0;  ///< its number on its owner
};

/// All of them, in the order of the curve. `leaves` are this rank's. Only the quadrants that touch the border
/// of this rank's part are looked at, so that the work grows with the border and not with the leaves.
/// *Collective.*
std::vector<Ghost> ghost_layer(const Communicator& comm, const Lattice& lattice, const CurveOwners& owners,
                               std::span<const Quadrant> leaves);

}  // namespace quadloop
