#include "mesher/layers/count_layers.hpp"

#include <algorithm>

#include "mesher/layers/front_places.hpp"

namespace quadloop {

namespace {

/// All nodes of a strip except the wall columns at which a wake begins.
std::int64_t nodes_of(const LayerStrip& strip) {
  const std::int64_t across = 2 * strip.layers + strip.core + 1, columns = std::ssize(strip.columns);
  if (!strip.root) return columns * across;
  const std::int64_t of_base = strip.base_layers() * std::int64_t{strip.core - 2 * strip.base_layers() - 1};
  return (columns - 1) * across + std::max(0, strip.core - 1) + of_base;
}

/// The largest number of a column's nodes that another column may own: all in a fan, the wall node at a
/// wake's edge.
int most_shared(const WallLine& line, const FrontPlace& place) {
  const Station& station = line[place.station];
  const bool beyond = !place.at_station() && line.width(place.station) > 0;
  if (station.shape != Station::Shape::fan || beyond) return 0;
  return station.at_wake ? 1 : line.spec(place.station).count;
}

}  // namespace

NodeBounds layer_nodes(const Communicator& comm, const LayerFront& front, const Mesh& outer) {
  const IdVector<NodeId, FrontPlace> places = places_of_nodes(comm, FrontPlaces(front), outer);
  NodeBounds nodes;
  for (const NodeId node : ids_below(NodeId{outer.owned_nodes})) {
    if (!places[node].valid()) continue;
    const int count = front.line.spec(places[node].station).count;
    nodes.most += count;
    nodes.least += count - most_shared(front.line, places[node]);
  }
  nodes = {comm.sum(nodes.least), comm.sum(nodes.most)};
  for (const LayerStrip& strip : front.strips) {
    nodes.least += nodes_of(strip);
    nodes.most += nodes_of(strip);
  }
  return nodes;
}

}  // namespace quadloop
