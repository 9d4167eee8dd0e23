#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

/// What every mesh obeys that may be written.
enum class MeshRule {
  indices,  ///< connectivity names existing nodes; every node belongs to a cell; coordinates are finite; no
            ///< boundary is empty
  coincident,  ///< no two nodes share a position but on the two sides of a crack: boundary edges that lie on
               ///< each other and run in opposite directions
  positive,    ///< cells are strictly convex and counter-clockwise, exactly and in rounded arithmetic
  conforming,  ///< no cell has a node twice; an edge has two cells in opposite directions, or one cell and
               ///< one boundary edge in its direction
  closed,      ///< boundary edges form closed loops, none is listed twice
  area,        ///< the cells' areas add up to what the boundary encloses (relative 1e-10)
  overlap,     ///< cells go round an inner node once; boundary edges meet at shared nodes only
  geometry,    ///< boundary nodes lie on their boundary, and its points near the mesh's boundary
};
const char* name_of(MeshRule rule);

/// One broken rule at one place.
struct MeshFault {
  MeshRule rule;
  std::string what;
  Point place;
};

/// To which block each cell belongs, where there are several.
struct CellBlocks {
  std::int32_t count = 1;
  std::span<const std::int32_t> of_triangle, of_quad;
};

/// All faults of a mesh that is whole on this rank, in the order of the rules; O(n log n). Where connectivity
/// or coordinates make no sense the later rules are not looked at.
std::vector<MeshFault> validate(const Mesh& mesh, const CellBlocks& blocks = {});

/// Those of them alone that no movement of nodes can cure: of the rules indices, conforming and closed.
std::vector<MeshFault> validate_topology(const Mesh& mesh, const CellBlocks& blocks = {});

/// Nodes where the boundary passes more than once (bow ties): allowed, but worth a figure. The mesh is valid.
std::int64_t pinched_nodes(const Mesh& mesh, const MeshTopology& topology);

/// The connected regions of a mesh: cells that edges join, so a pinched node does not connect.
struct MeshRegions {
  std::int64_t count = 0;
  std::int64_t smallest_cells = 0;  ///< cells of the region with the fewest
  Point smallest_place;             ///< a node of it
};

/// Of a mesh that is whole on this rank; linear in time. `topology` keeps all edges.
MeshRegions connected_regions(const Mesh& mesh, const MeshTopology& topology);

/// How a mesh follows its geometry.
struct GeometryFit {
  std::vector<MeshFault> faults;
  std::int64_t boundaries_dropped = 0;  ///< of the geometry, that the mesh lacks
  std::int64_t loops_dropped = 0;  ///< loops, or open chains, on which no boundary node lies; a fault where
                                   ///< they are longer than the cells there
  /// Points where a closed boundary turns by more than 30 degrees, ends of open ones.
  std::int64_t sharp_corners = 0;
  std::int64_t sharp_corners_lost = 0;  ///< of these, no mesh node
  double boundary_node_distance = 0;    ///< largest distance of a boundary node to its boundary
  double geometry_distance = 0;  ///< largest distance of a point of the geometry to its boundary in the mesh
  double area_error = 0;         ///< relative
};

/// What chords cut off, and small islands that are dropped, may make of the area in all, as a share; a mesh
/// that misses more is not of its geometry.
inline constexpr double largest_area_error = 0.05;

/// Compares a valid mesh, whole on this rank, with the polylines it was made from. `tolerance` is relative to
/// the mesh's extent.
GeometryFit validate_geometry(const Mesh& mesh, std::span<const Chain> geometry, double tolerance = 1e-9);

}  // namespace quadloop
