#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Minimum, median (for an even number the larger of the middle two) and maximum of some values; 0 if there
/// are none.
struct Spread {
  double least = 0, median = 0, largest = 0;
};

/// Measured layers of one boundary or strip. A column consists of the nodes above a wall node: the nearest
/// first, then the straightest continuation; at a sharp edge, where many start, one of them. A strip's column
/// counts once and is measured on both sides of its line; behind a blunt edge from the two lines where the
/// rows between its sides end.
struct LayerStatistics {
  std::string boundary;  ///< or name of the strip
  std::int32_t count = 0;
  std::int64_t columns = 0;      ///< number of measured columns
  std::int64_t cut_columns = 0;  ///< of a partition: columns at its border to another one, not measured
  Spread first;                  ///< heights of the first layer, normal to the wall
  Spread growth;     ///< ratio of each layer to the one below, along the column; over all layers and columns
  Spread thickness;  ///< total thickness, along the column
  double asked = 0;  ///< requested total thickness; 0: not known
};

/// Measures all boundaries with layers, then all strips. `halo` and `places` are those of `mesh`. A column is
/// followed from rank to rank. Bitwise independent of the number of ranks. *Collective.*
std::vector<LayerStatistics> layer_statistics(const Communicator& comm, const Mesh& mesh,
                                              const HaloMesh& halo, const LayerPlaces& places);

/// Quality of the cells in layers and of the others.
struct QualityByLayers {
  QualitySummary layers, others;
};

/// *Collective.*
QualityByLayers quality_by_layers(const Communicator& comm, const Mesh& mesh, const LayerPlaces& places);

}  // namespace quadloop
