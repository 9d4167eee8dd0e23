#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/check/edge_statistics.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

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

/// Compares a valid mesh with the polylines it was made from; `halo` and `edges` are its. The root gets the
/// boundary edges only, and the result. `tolerance` is relative to the mesh's extent. `blocks` has the blocks
/// of this rank's cells; with several the polylines must have points where blocks meet; one between two
/// blocks may occur twice, once in each direction: then the mesh must have cells on both sides of it.
/// Boundaries of the mesh that are inner lines are compared too. Independent of the number of ranks.
/// *Collective.*
GeometryFit validate_geometry(const Communicator& comm, const Mesh& mesh, const HaloMesh& halo,
                              const EdgeStatistics& edges, std::span<const Chain> geometry,
                              const CellBlocks& blocks = {}, double tolerance = 1e-9);

/// The same for a mesh that is whole on this rank.
GeometryFit validate_geometry(const Mesh& whole, std::span<const Chain> geometry,
                              const CellBlocks& blocks = {}, double tolerance = 1e-9);

}  // namespace quadloop
