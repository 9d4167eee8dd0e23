#pragma once

#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// An edge of a mesh's boundary.
struct WallSpan {
  double from_x = 0, from_y = 0, to_x = 0, to_y = 0;
  std::int32_t boundary = 0;  ///< index among the mesh's boundaries

  Point from() const { return {from_x, from_y}; }
  Point to() const { return {to_x, to_y}; }
  friend auto operator<=>(const WallSpan&, const WallSpan&) = default;
};

/// Boundary edges of all ranks, sorted. *Collective.*
std::vector<WallSpan> wall_edges(const Communicator& comm, const Mesh& mesh);

struct CrossingWalls {
  WallSpan one, other;
};

/// The first two edges that meet other than at one common end, by an exact test: chords on both sides of a
/// thin island may cross although every cell beside them is positive. Pairs of edges that are both in `known`
/// are ignored, as they met before. Both lists are sorted.
std::optional<CrossingWalls> crossing_walls(const std::vector<WallSpan>& edges,
                                            const std::vector<WallSpan>& known);

}  // namespace quadloop::adapt
