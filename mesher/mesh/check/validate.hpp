#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/topology.hpp"

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

/// Counts nodes where the boundary passes more than once (non-manifold boundary nodes): allowed, but
/// reported. The mesh must be valid.
std::int64_t pinched_nodes(const Mesh& mesh, const MeshTopology& topology);

/// The connected regions of a mesh: cells connected by edges; a pinched node does not connect.
struct MeshRegions {
  std::int64_t count = 0;
  std::int64_t smallest_cells = 0;  ///< number of cells of the smallest region
  Point smallest_place;             ///< one of its nodes
};

/// The mesh must be whole on this rank; linear in time. `topology` must keep all edges.
MeshRegions connected_regions(const Mesh& mesh, const MeshTopology& topology);

/// How well a mesh fits its geometry.
struct GeometryFit {
  std::vector<MeshFault> faults;
  std::int64_t boundaries_dropped = 0;  ///< boundaries of the geometry that the mesh lacks
  /// Loops, or open chains, without a boundary node; an error if they are longer than the cells there.
  std::int64_t loops_dropped = 0;
  /// Points where a closed boundary turns by more than 30 degrees, and ends of open ones.
  std::int64_t sharp_corners = 0;
  std::int64_t sharp_corners_lost = 0;  ///< of these, those without a mesh node
  double boundary_node_distance = 0;    ///< largest distance of a boundary node from its boundary
  /// Largest distance of a point of the geometry from its boundary in the mesh.
  double geometry_distance = 0;
  double area_error = 0;                       ///< relative
  std::vector<double> block_area_errors = {};  ///< the same of each block, if there are several
};

/// Largest relative area error from chords and dropped small islands; a mesh with a larger one does not
/// belong to its geometry.
inline constexpr double largest_area_error = 0.05;

/// Compares a valid mesh, whole on this rank, with the polylines it was made from. `tolerance` is relative to
/// the mesh's extent. With several blocks the polylines must have points where blocks meet; one between two
/// blocks may occur twice, once in each direction: then the mesh must have cells on both sides of it.
/// Boundaries of the mesh that are inner lines are compared too.
GeometryFit validate_geometry(const Mesh& mesh, std::span<const Chain> geometry,
                              const CellBlocks& blocks = {}, double tolerance = 1e-9);

}  // namespace quadloop
