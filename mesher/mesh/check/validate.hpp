#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/point.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Rules that every written mesh satisfies.
enum class MeshRule {
  /// Connectivity refers to existing nodes; every node belongs to a cell; coordinates are finite; no boundary
  /// is empty.
  indices,
  /// No two nodes coincide, except on the two sides of a crack: coincident boundary edges in opposite
  /// directions.
  coincident,
  positive,    ///< cells are strictly convex and counter-clockwise, exactly and in rounded arithmetic
  conforming,  ///< no cell has a node twice; an edge has two cells in opposite directions, or one cell and
               ///< one boundary edge in its direction
  closed,      ///< boundary edges form closed loops, none is listed twice
  area,        ///< the cells' areas sum to that enclosed by the boundary (relative 1e-10)
  overlap,     ///< cells wind once around an inner node; boundary edges meet only at shared nodes
  pairs,       ///< the nodes of a periodic pair are images of each other
  geometry,    ///< boundary nodes lie on their boundary, and points of the geometry near the mesh's boundary
};
const char* name_of(MeshRule rule);

/// A violated rule with its location.
struct MeshFault {
  MeshRule rule;
  std::string what;
  Point place;
};

/// Block of each cell, if there are several blocks.
struct CellBlocks {
  std::int32_t count = 1;
  std::span<const std::int32_t> of_triangle, of_quad;

  /// Returns the block of a cell; triangles come first.
  std::int32_t of(std::size_t cell) const {
    if (count == 1) return 0;
    return cell < of_triangle.size() ? of_triangle[cell] : of_quad[cell - of_triangle.size()];
  }
};

/// Returns the blocks of a whole mesh.
inline CellBlocks cell_blocks(const Mesh& mesh) {
  return {std::max(1, size32(mesh.blocks.names)), mesh.blocks.of_triangles, mesh.blocks.of_quads};
}

/// Returns all errors of a mesh that is whole on this rank, in the order of the rules; O(n log n). If
/// connectivity or coordinates are invalid, the later rules are skipped.
std::vector<MeshFault> validate(const Mesh& mesh, const CellBlocks& blocks = {});

/// Returns only the errors that moving nodes cannot repair: those of the rules indices, conforming and
/// closed.
std::vector<MeshFault> validate_topology(const Mesh& mesh, const CellBlocks& blocks = {});

}  // namespace quadloop
