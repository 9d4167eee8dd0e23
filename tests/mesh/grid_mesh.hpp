#pragma once

#include <cstdint>
#include <vector>

#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/scatter_mesh.hpp"

namespace quadloop::test {

/// A number in [-1, 1) that its keys alone decide.
double scattered(std::uint64_t seed, std::int64_t number, int which);

/// A regular grid on a rectangle, whole, n x n cells: quads, some of them split into two triangles by either
/// diagonal. Nodes row by row.
struct Grid {
  std::int32_t n = 8;
  Point size{1, 1};
  bool quads = true;  ///< else all are split

  /// Boundaries "wall" (south, east) and "far" (north, west).
  Mesh mesh() const;
  bool inner(std::int32_t node) const;
  Point place(std::int32_t node) const;
};

/// Moves each node by up to `share` of the grid's steps, those of the sides along them, and no corner. Under
/// a quarter no cell is inverted.
void jitter(const Grid& grid, double share, std::uint64_t seed, Mesh& mesh);

/// An order that leaves no neighbours together.
MeshOrder shuffled_order(const Mesh& whole, std::uint64_t seed);

}  // namespace quadloop::test
