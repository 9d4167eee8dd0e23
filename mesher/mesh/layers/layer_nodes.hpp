#pragma once

#include <algorithm>
#include <cstdint>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Position of a node in the layers of a boundary or of a strip.
struct LayerPlace {
  std::int32_t left = -1;      ///< number of edges to the outer edge of the layers; negative: not in layers
  std::int32_t boundary = -1;  ///< boundary of the layers: index into Mesh::boundaries
  std::int32_t strip = -1;     ///< strip of the layers: index into Mesh::strips; -1: none

  bool valid() const { return left >= 0; }
  friend bool operator==(const LayerPlace&, const LayerPlace&) = default;
};

using LayerPlaces = IdVector<NodeId, LayerPlace>;  ///< for owned nodes and ghosts

/// Whether any boundary has layers, or there are strips; the same on every rank.
bool has_layers(const Mesh& mesh);

/// Finds the nodes of strips, and those of layers on walls from connectivity alone: at most as many edges
/// away from the wall as it has layers. The wall consists of the boundaries with layers, and of adjacent
/// boundaries up to the first corner of 45 to 135 degrees, as in layer generation. Linear, but each rank
/// temporarily stores all boundary edges. *Collective.*
LayerPlaces layer_places(const Communicator& comm, const Mesh& mesh);

/// Returns the layers of the boundary or strip of a valid place.
inline const WallLayers& layers_at(const Mesh& mesh, const LayerPlace& place) {
  return place.strip >= 0 ? mesh.strips[place.strip].layers : mesh.boundaries[place.boundary].layers;
}

/// Whether all layers are above the node: it lies on the wall or on a strip's line (behind a blunt edge, on
/// the two lines where its rows end).
inline bool on_layered_wall(const Mesh& mesh, const LayerPlace& place) {
  return place.valid() && place.left == layers_at(mesh, place).count;
}

/// Whether a cell is in layers: all its nodes are, and not all of them on the outer edge.
template <class Nodes>
bool is_layer_cell(const LayerPlaces& places, const Nodes& nodes) {
  return std::ranges::all_of(nodes, [&](NodeId node) { return places[node].valid(); }) &&
         std::ranges::any_of(nodes, [&](NodeId node) { return places[node].left > 0; });
}

/// Returns the height of the layers above each node, ghosts included: the least sum of edges, one for each
/// layer, up to the outer edge. At the wall this is the length of the column. 0 outside layers. Bitwise
/// independent of the number of ranks. *Collective.*
IdVector<NodeId, double> heights_to_front(const Communicator& comm, const Mesh& mesh,
                                          const LayerPlaces& places);

}  // namespace quadloop
