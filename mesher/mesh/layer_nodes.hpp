#pragma once

#include <algorithm>
#include <cstdint>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Where a node stands in the layers of a boundary.
struct LayerPlace {
  std::int32_t left = -1;      ///< edges from it on to the front, where the layers end; below 0: in no layers
  std::int32_t boundary = -1;  ///< whose layers they are: index into Mesh::boundaries

  bool valid() const { return left >= 0; }
  friend bool operator==(const LayerPlace&, const LayerPlace&) = default;
};

using LayerPlaces = IdVector<NodeId, LayerPlace>;  ///< of each node, copies too

/// Whether any boundary is said to carry layers; the same on every rank.
bool has_layers(const Mesh& mesh);

/// The nodes of layers, as edges alone tell: those that are at most as many edges away from the wall as it
/// has layers. The wall is that of the boundaries with layers, and of the boundaries which follow them up to
/// the first corner of 45 to 135 degrees, as layers are made. Linear, but that each rank holds all boundary
/// edges for a while. *Collective.*
LayerPlaces layer_places(const Communicator& comm, const Mesh& mesh);

/// Whether the node is one of the wall's.
inline bool on_layered_wall(const Mesh& mesh, const LayerPlace& place) {
  return place.valid() && place.left == mesh.boundaries[place.boundary].layers.count;
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
