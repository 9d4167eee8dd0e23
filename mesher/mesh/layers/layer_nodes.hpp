#pragma once

#include <algorithm>
#include <cstdint>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Where a node stands in the layers of a boundary or of a strip.
struct LayerPlace {
  std::int32_t left = -1;      ///< edges from it on to where the layers end; below 0: in no layers
  std::int32_t boundary = -1;  ///< whose layers they are: index into Mesh::boundaries
  std::int32_t strip = -1;     ///< or of which strip: index into Mesh::strips

  bool valid() const { return left >= 0; }
  friend bool operator==(const LayerPlace&, const LayerPlace&) = default;
};

using LayerPlaces = IdVector<NodeId, LayerPlace>;  ///< of each node, copies too

/// Whether any boundary is said to carry layers, or there are strips; the same on every rank.
bool has_layers(const Mesh& mesh);

/// The nodes of strips, and those of layers on walls, as edges alone tell: at most as many edges away from
/// the wall as it has layers. The wall is that of the boundaries with layers, and of the boundaries which
/// follow them up to the first corner of 45 to 135 degrees, as layers are made. Linear, but that each rank
/// holds all boundary edges for a while. *Collective.*
LayerPlaces layer_places(const Communicator& comm, const Mesh& mesh);

/// The layers of the boundary or the strip in which a valid place is.
inline const WallLayers& layers_at(const Mesh& mesh, const LayerPlace& place) {
  return place.strip >= 0 ? mesh.strips[place.strip].layers : mesh.boundaries[place.boundary].layers;
}

/// Whether all layers are above the node: it is one of the wall's, or of a strip's line (behind a blunt edge
/// of the two lines on which its rows lie).
inline bool on_layered_wall(const Mesh& mesh, const LayerPlace& place) {
  return place.valid() && place.left == layers_at(mesh, place).count;
}

/// Whether a cell lies in layers: all its nodes do, and not all of them on the front.
template <class Nodes>
bool is_layer_cell(const LayerPlaces& places, const Nodes& nodes) {
  return std::ranges::all_of(nodes, [&](NodeId node) { return places[node].valid(); }) &&
         std::ranges::any_of(nodes, [&](NodeId node) { return places[node].left > 0; });
}

/// How high the layers reach above each of their nodes, copies too: the least sum of edges, one for each
/// layer, on to the front. Above the wall that is the column's length. 0 elsewhere. The same bits on any
/// number of ranks. *Collective.*
IdVector<NodeId, double> heights_to_front(const Communicator& comm, const Mesh& mesh,
                                          const LayerPlaces& places);

}  // namespace quadloop
