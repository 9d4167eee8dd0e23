#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The least, the median (of an even number the larger of the middle two) and the largest of some values; 0
/// where there are none.
struct Spread {
  double least = 0, median = 0, largest = 0;
};

/// The layers of one boundary or strip, measured. A column is the nodes above a node of the wall, the nearest
/// first and then the straightest on; at a sharp edge, where many rise, one of them. A strip's column counts
/// once and is measured on both sides of its line, behind a blunt edge of the lines on which the rows between
/// its sides end.
struct LayerFigures {
  std::string boundary;  ///< or the strip's name
  std::int32_t count = 0;
  std::int64_t columns = 0;      ///< that were measured
  std::int64_t cut_columns = 0;  ///< of a part of a mesh: those at its border to another part, not measured
  Spread first;                  ///< heights of the layer at the wall, normal to it
  Spread growth;                 ///< of each layer over the one below, along the column; all of all columns
  Spread thickness;              ///< of all layers, along the column
  double asked = 0;              ///< of that what was asked for; 0: not known
};

/// Those of all boundaries with columns of layers, then of all strips, of a mesh that this rank holds whole.
std::vector<LayerFigures> layer_figures(const Mesh& whole, const LayerPlaces& places);

/// Shapes of the cells in layers, and of the others.
struct QualityByLayers {
  QualitySummary layers, others;
};

/// *Collective.*
QualityByLayers quality_by_layers(const Communicator& comm, const Mesh& mesh, const LayerPlaces& places);

}  // namespace quadloop
