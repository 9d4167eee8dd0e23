#pragma once

#include <cstdint>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// What cell-centred finite volumes judge a mesh by, as OpenFOAM's checkMesh defines it for the mesh extruded
/// by one layer of cells: faces are edges, cell centres centroids.
struct FaceFigures {
  static constexpr double severe_degrees = 70, severe_skewness = 4, severe_aspect_ratio = 1000;

  double non_orthogonality =
      0;  ///< largest angle in degrees between an edge's normal and the line that joins the centres
  /// Largest distance of the edge's middle from where that line meets the edge, by half the edge's length or
  /// a fifth of the line's (at the boundary two fifths), whichever is larger.
  double skewness = 0;
  double aspect_ratio = 0;  ///< largest of a cell's longest edge by its mean height on that edge
  std::int64_t non_orthogonal = 0, skew = 0;  ///< edges above severe_degrees and severe_skewness
  std::int64_t flat =
      0;  ///< cells whose box along the axes is above severe_aspect_ratio, as checkMesh counts
};

/// An edge of a cell in layers counts as one of the layers.
struct FaceFiguresByLayers {
  FaceFigures layers, others;
};

/// Largest values, and counts, over all ranks; the same on any number of them. `places` is empty where there
/// are no layers. *Collective.*
FaceFiguresByLayers face_figures(const Communicator& comm, const Mesh& mesh, const LayerPlaces& places);

}  // namespace quadloop
