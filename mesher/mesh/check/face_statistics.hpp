#pragma once

#include <cstdint>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Quality measures for cell-centred finite volumes, as defined by OpenFOAM's checkMesh for the mesh extruded
/// by one cell: faces are edges, cell centres are centroids. Edges on the sides of periodic pairs are faces
/// of cyclic patches, between two cells; where join_pairs() is not possible they are outer edges.
struct FaceStatistics {
  static constexpr double severe_degrees = 70, severe_skewness = 4, severe_aspect_ratio = 1000;

  /// Largest angle in degrees between an edge's normal and the line between the cell centres.
  double non_orthogonality = 0;
  /// Largest distance from the edge's midpoint to the point where that line meets the edge, divided by half
  /// the edge's length or a fifth of the line's (at the boundary two fifths), whichever is larger.
  double skewness = 0;
  double aspect_ratio = 0;  ///< largest ratio of a cell's longest edge to its mean height on that edge
  std::int64_t non_orthogonal = 0, skew = 0;  ///< numbers of edges above severe_degrees and severe_skewness
  std::int64_t flat = 0;  ///< number of cells whose bounding box exceeds severe_aspect_ratio, as in checkMesh
};

/// Edges of cells in layers count as layers.
struct FaceStatisticsByLayers {
  FaceStatistics layers, others;
};

/// Returns maxima and counts over all ranks, independent of their number. `places` is empty if there are no
/// layers. *Collective.*
FaceStatisticsByLayers face_statistics(const Communicator& comm, const Mesh& mesh, const LayerPlaces& places);

}  // namespace quadloop
