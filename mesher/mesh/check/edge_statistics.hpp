#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// An edge with a cell on its left and none on its right.
struct OneSidedEdge {
  NodeId from, to;        ///< nodes of the HaloMesh; this rank owns one of them at least
  std::int64_t cell = 0;  ///< global number of the cell; triangles come before quads
  std::int32_t side = 0;  ///< the edge begins at this node of the cell
};

/// Ratios of the two cell areas at each inner edge, larger by smaller: maximum and 99th percentile. Infinite
/// for cells without area, 0 without inner edges.
struct AreaRatios {
  double largest = 0, of_99_percent = 0;
  /// Middle of the edge with the largest one, of several that of the first cell.
  Point place = {};
};

/// The connected regions of a mesh: cells connected by edges; a pinched node does not connect.
struct MeshRegions {
  std::int64_t count = 0;
  std::int64_t smallest_cells = 0;  ///< number of cells of the smallest region
  Point smallest_place;             ///< first node of its first cell
};

/// What is found at the edges of a distributed mesh.
struct EdgeStatistics {
  AreaRatios ratios;
  MeshRegions regions;
  std::int64_t between_blocks = 0;  ///< edges with cells of two blocks
  /// Nodes where the boundary passes more than once (non-manifold boundary nodes): allowed, but reported.
  std::int64_t pinched_nodes = 0;
  std::vector<OneSidedEdge> one_sided;  ///< at this rank's nodes: once on each rank that owns an end
};

/// Visits each edge once. `halo` is that of `mesh`, `blocks` has the blocks of this rank's cells. Memory of
/// about 40 bytes per cell of this rank. Independent of the number of ranks. *Collective.*
EdgeStatistics edge_statistics(const Communicator& comm, const Mesh& mesh, const HaloMesh& halo,
                               const CellBlocks& blocks = {});

/// The ratios alone. *Collective.*
AreaRatios area_ratios(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
