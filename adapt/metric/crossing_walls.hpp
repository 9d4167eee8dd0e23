#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// An edge of a mesh's boundary.
struct WallSpan {
  double from_x = 0, from_y = 0, to_x = 0, to_y = 0;
  std::int32_t boundary = 0;  ///< among the mesh's

  Point from() const { return {from_x, from_y}; }
  Point to() const { return {to_x, to_y}; }
  friend auto operator<=>(const WallSpan&, const WallSpan&) = default;
};

/// Those of all ranks, sorted by their places. *Collective.*
std::vector<WallSpan> wall_edges(const Communicator& comm, const Mesh& mesh);

struct CrossingWalls {
  WallSpan one, other;
};

/// The first two edges that meet elsewhere than at one common end, tested exactly: chords of both sides of a
/// thin island may, though every cell beside them is positive. Pairs that both are among `known`, sorted too,
/// are left out: they were so before. Edges are sorted.
std::optional<CrossingWalls> crossing_walls(const std::vector<WallSpan>& edges,
                                            const std::vector<WallSpan>& known);

}  // namespace quadloop
