#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// Consecutive nodes of a wall, with the domain to its left, between two corners of more than 30 degrees,
/// or all around a body without corners.
struct WallPiece {
  std::size_t wall = 0;       ///< index in the list of names
  std::vector<Point> points;  ///< at least two; the first one is not repeated at the end of a closed piece
  bool closed = false;

  std::size_t edges() const { return closed ? points.size() : points.size() - 1; }
  std::size_t next(std::size_t k) const { return k + 1 < points.size() ? k + 1 : 0; }
  std::size_t previous(std::size_t k) const { return k > 0 ? k - 1 : points.size() - 1; }
  /// The unit normal into the domain at a node: the bisector of its edges.
  Point normal(std::size_t k) const;
};

/// The walls of all ranks with these names; the same on every rank, in an order that does not depend on the
/// number of ranks. *Collective.*
std::vector<WallPiece> wall_pieces(const Communicator& comm, const Mesh& mesh,
                                   std::span<const std::string> names);

/// Removes single odd values at the nodes of a piece: each becomes the median of those at up to two nodes on
/// either side, then twice the weighted mean (1, 2, 1) / 4 with both neighbours. 0 means unknown: such values
/// do not count, and where they are the majority the value is unknown. A reversed piece has reversed values.
std::vector<double> smoothed(const WallPiece& piece, std::vector<double> values);

}  // namespace quadloop::adapt
