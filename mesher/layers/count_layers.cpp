#include "mesher/layers/count_layers.hpp"

#include <algorithm>

#include "mesher/layers/front_places.hpp"

namespace quadloop {

namespace {

/// All of a strip but the wall's columns from which a wake goes on.
std::int64_t nodes_of(const LayerStrip& strip) {
  const std::int64_t across = 2 * strip.layers + strip.core + 1, columns = std::ssize(strip.columns);
  if (!strip.root) return columns * across;
  return (columns - 1) * across + std::max(0, strip.core - 1);
}

}  // namespace

std::int64_t most_layer_nodes(const Communicator& comm, const LayerFront& front, const Mesh& outer) {
  const IdVector<NodeId, FrontPlace> places = places_of_nodes(comm, FrontPlaces(front), outer);
  std::int64_t nodes = 0;
  for (const NodeId node : ids_below(NodeId{outer.owned_nodes})) {
    if (places[node].valid()) nodes += front.line.spec(places[node].station).count;
  }
  nodes = comm.sum(nodes);
  for (const LayerStrip& strip : front.strips) nodes += nodes_of(strip);
  return nodes;
}

}  // namespace quadloop
