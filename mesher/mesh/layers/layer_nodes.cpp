#include "mesher/mesh/layers/layer_nodes.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <unordered_map>

#include "mesher/mesh/layers/layered_edges.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

/// Neighbours of each node along edges of this rank's cells; those of an edge between two cells are listed
/// twice.
class Neighbours {
 public:
  explicit Neighbours(const Mesh& mesh) : starts_(mesh.points.size() + 1) {
    for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t) {
      ++starts_[from.value() + 1];
      ++starts_[to.value() + 1];
    });
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    nodes_.resize(starts_.back());
    std::vector<std::int64_t> next(starts_.begin(), starts_.end() - 1);
    for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t) {
      nodes_[next[from.value()]++] = to;
      nodes_[next[to.value()]++] = from;
    });
  }
  std::span<const NodeId> of(NodeId node) const {
    const std::size_t at = node.value();
    return std::span(nodes_).subspan(starts_[at], starts_[at + 1] - starts_[at]);
  }

 private:
  std::vector<std::int64_t> starts_;
  std::vector<NodeId> nodes_;
};

/// Shares the best value of a node among all ranks that hold it.
template <class Value>
class BestOfAll {
 public:
  using Better = bool (*)(const Value&, const Value&);

  BestOfAll(const Communicator& comm, const Mesh& mesh, Better better)
      : comm_{comm},
        mesh_{mesh},
        better_{better},
        owners_{comm, mesh.first_node},
        exchange_{comm, owners_, mesh.owned_nodes, mesh.ghosts} {}

  /// Updates ghosts from their owners. *Collective.*
  template <class Values>
  void update_ghosts(Values& values) const {
    exchange_.update(values);
  }

  /// Returns the nodes of this rank whose value has improved. *Collective.*
  std::vector<NodeId> share(IdVector<NodeId, Value>& values) const {
    const IdVector<NodeId, Value> before = values;
    struct Offer {
      GlobalNodeId node;
      Value value;
    };
    Outbox<Offer> offers;
    for (const NodeId node : ids_between(NodeId{mesh_.owned_nodes}, NodeId{size32(values)})) {
      const GlobalNodeId id = mesh_.global(node);
      offers.add(owners_.rank_of(id), {id, values[node]});
    }
    for (const Offer& offer : offers.deliver(comm_)) {
      Value& value = values[owners_.local(offer.node)];
      if (better_(offer.value, value)) value = offer.value;
    }
    exchange_.update(values);
    std::vector<NodeId> changed;
    for (const NodeId node : values.ids()) {
      if (better_(values[node], before[node])) changed.push_back(node);
    }
    return changed;
  }

 private:
  const Communicator& comm_;
  const Mesh& mesh_;
  Better better_;
  NodeOwners owners_;
  NodeExchange exchange_;
};

/// A node in a strip keeps its place.
bool deeper(const LayerPlace& a, const LayerPlace& b) {
  if (b.strip >= 0) return false;
  return a.left != b.left ? a.left > b.left : a.boundary < b.boundary;
}

bool lower(const double& a, const double& b) { return a < b; }

/// Propagates layers from the given nodes, as far as they extend.
void spread(const Neighbours& neighbours, std::vector<NodeId> from, LayerPlaces& places) {
  for (std::size_t next = 0; next < from.size(); ++next) {
    const NodeId node = from[next];
    const LayerPlace beyond{places[node].left - 1, places[node].boundary};
    if (!beyond.valid()) continue;
    for (const NodeId other : neighbours.of(node)) {
      if (!deeper(beyond, places[other])) continue;
      places[other] = beyond;
      from.push_back(other);
    }
  }
}

/// Places the nodes of strips that are on this rank; those of a wall's own columns belong to the wall.
void place_strips(const Mesh& mesh, LayerPlaces& places) {
  if (mesh.strips.empty()) return;
  std::unordered_map<GlobalNodeId, NodeId> ghosts;
  for (const NodeId node : ids_between(NodeId{mesh.owned_nodes}, NodeId{size32(mesh.points)}))
    ghosts.emplace(mesh.global(node), node);
  const auto local = [&](GlobalNodeId node) {
    const std::int64_t offset = node.value() - mesh.first_node;
    if (0 <= offset && offset < mesh.owned_nodes) return NodeId{static_cast<std::int32_t>(offset)};
    const auto found = ghosts.find(node);
    return found == ghosts.end() ? NodeId{} : found->second;
  };
  for (std::int32_t s = 0; s < size32(mesh.strips); ++s) {
    const StripLayers& strip = mesh.strips[s];
    for (std::int32_t column = 0; column < strip.columns(); ++column) {
      for (std::int32_t row = 0; row < strip.across; ++row) {
        if (strip.is_walls(column, row)) continue;
        const NodeId node = local(strip.node(column, row));
        if (node.valid()) places[node] = {std::min(row, strip.across - 1 - row), -1, s};
      }
    }
  }
}

/// Returns this rank's nodes on walls with layers.
std::vector<NodeId> wall_nodes(const Communicator& comm, const Mesh& mesh, LayerPlaces& places) {
  std::vector<NodeId> nodes;
  for (const LayeredEdge& edge : layered_edges(comm, mesh)) {
    for (const NodeId node : edge.nodes) {
      const LayerPlace place{mesh.boundaries[edge.layers].layers.count, edge.layers};
      if (!deeper(place, places[node])) continue;
      places[node] = place;
      nodes.push_back(node);
    }
  }
  return nodes;
}

/// Returns the nodes of layers, from the outer edge to the wall.
std::vector<NodeId> from_front(const LayerPlaces& places) {
  std::vector<NodeId> nodes;
  for (const NodeId node : places.ids()) {
    if (places[node].valid()) nodes.push_back(node);
  }
  std::ranges::stable_sort(nodes, {}, [&](NodeId node) { return places[node].left; });
  return nodes;
}

}  // namespace

bool has_layers(const Mesh& mesh) {
  return !mesh.strips.empty() ||
         std::ranges::any_of(mesh.boundaries, [](const BoundaryEdges& b) { return b.layers.count > 0; });
}

LayerPlaces layer_places(const Communicator& comm, const Mesh& mesh) {
  LayerPlaces places(mesh.points.size());
  if (!has_layers(mesh)) return places;
  const Neighbours neighbours(mesh);
  const BestOfAll<LayerPlace> best(comm, mesh, deeper);
  place_strips(mesh, places);
  for (std::vector<NodeId> news = wall_nodes(comm, mesh, places);;) {
    spread(neighbours, news, places);
    news = best.share(places);
    if (!comm.any(!news.empty())) return places;
  }
}

IdVector<NodeId, double> heights_to_front(const Communicator& comm, const Mesh& mesh,
                                          const LayerPlaces& places) {
  constexpr double unknown = std::numeric_limits<double>::infinity();
  IdVector<NodeId, double> heights(mesh.points.size(), unknown);
  if (!has_layers(mesh)) return IdVector<NodeId, double>(mesh.points.size(), 0);
  const Neighbours neighbours(mesh);
  const std::vector<NodeId> nodes = from_front(places);
  const BestOfAll<double> best(comm, mesh, lower);
  std::vector<Point> points = mesh.points;
  best.update_ghosts(points);  // a ghost may differ by rounding, and heights would depend on the ranks
  const auto edge = [&](NodeId a, NodeId b) { return length(points[b.value()] - points[a.value()]); };
  do {
    for (const NodeId node : nodes) {
      const LayerPlace& place = places[node];
      const LayerPlace beyond{place.left - 1, place.boundary, place.strip};
      if (!beyond.valid()) heights[node] = 0;
      for (const NodeId other : neighbours.of(node)) {
        if (places[other] != beyond) continue;
        heights[node] = std::min(heights[node], heights[other] + edge(node, other));
      }
    }
  } while (comm.any(!best.share(heights).empty()));
  for (double& height : heights) height = std::isfinite(height) ? height : 0;
  return heights;
}

}  // namespace quadloop
