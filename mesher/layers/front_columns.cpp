#include "mesher/layers/front_columns.hpp"

#include <algorithm>
#include <iterator>
#include <map>

#include "mesher/layers/layer_column.hpp"

namespace quadloop {

FrontColumns::FrontColumns(const Communicator& comm, const LayerFront& front, const Mesh& outside)
    : comm_{comm},
      front_{front},
      outside_{outside},
      places_on_{front},
      fans_{front},
      owners_{comm, outside.first_node},
      place_(outside.points.size(), {}),
      numbered_(outside.points.size(), {}),
      columns_(outside.points.size(), {}) {
  find_places();
  gather_rays();
  number_nodes();
  gather_rays();  // now with their numbers
  make_columns();
}

/// On the ranks that own the nodes, and on those with an edge there.
void FrontColumns::find_places() {
  struct Asked {
    GlobalNodeId node;
    BoundaryId boundary;
  };
  Outbox<Asked> asked;
  for (std::size_t b = 0; b < outside_.boundaries.size(); ++b) {
    const BoundaryId boundary{static_cast<std::int32_t>(b)};
    for (const auto& edge : outside_.boundaries[b].edges) {
      const std::array places{places_on_.locate(outside_.point(edge[0]), boundary),
                              places_on_.locate(outside_.point(edge[1]), boundary)};
      if (!places_on_.follows(places[0], places[1])) continue;
      for (const std::size_t k : {0, 1}) {
        place_[edge[k]] = places[k];
        const GlobalNodeId node = outside_.global(edge[k]);
        if (!outside_.owns(edge[k])) asked.add(owners_.rank_of(node), {node, boundary});
      }
    }
  }
  for (const Asked& a : asked.deliver(comm_)) {
    const NodeId node = owners_.local(a.node);
    place_[node] = places_on_.locate(outside_.point(node), a.boundary);
  }
}

void FrontColumns::gather_rays() {
  std::vector<Ray> own;
  for (const NodeId node : ids_below(NodeId{outside_.owned_nodes})) {
    if (place_[node].valid() && fan_of(node) != WallLine::none) own.push_back(ray_at(node));
  }
  fans_.gather(comm_, own);
}

void FrontColumns::number_nodes() {
  const auto owned = ids_below(NodeId{outside_.owned_nodes});
  std::vector<std::int32_t> counts;
  for (const NodeId node : owned) {
    const bool has_column = place_[node].valid();
    counts.push_back(1 +
                     (has_column ? line().spec(place_[node].station).count - lowest_ring(ray_at(node)) : 0));
    owned_nodes_ += counts.back();
  }
  first_node_ = comm_.exclusive_sum(owned_nodes_);
  std::int64_t next = first_node_;
  for (const NodeId node : owned) {
    numbered_[node] = GlobalNodeId{next};
    next += counts[node.value()];
  }
  NodeExchange(comm_, owners_, outside_.owned_nodes, outside_.copies).update(numbered_);
}

void FrontColumns::make_columns() {
  for (const NodeId node : place_.ids()) {
    if (place_[node].valid()) columns_[node] = column_on(ray_at(node));
  }
}

Ray FrontColumns::ray_at(NodeId node) const {
  return {fan_of(node), place_[node], outside_.global(node), numbered_[node], outside_.point(node)};
}

/// The lowest ring that belongs to the column itself.
int FrontColumns::lowest_ring(const Ray& ray) const {
  if (ray.fan == WallLine::none) return 0;
  const std::int32_t number = fans_.ray_on(ray.fan, ray.node);
  return number == 0 ? 0 : fans_.rows_of(ray.fan).lowest_ring(number);
}

std::vector<LayerNode> FrontColumns::column_on(const Ray& ray) const {
  std::vector<LayerNode> nodes;
  const int lowest = lowest_ring(ray);
  for (const Point p : layer_column(front_, ray.place, ray.point)) {
    const int ring = static_cast<int>(nodes.size());
    nodes.push_back(
        {ring < lowest ? GlobalNodeId{} : GlobalNodeId{ray.numbered.value() + 1 + ring - lowest}, p});
  }
  nodes.push_back({ray.numbered, ray.point});
  if (ray.fan != WallLine::none) nodes.front() = apex(ray.fan);
  return nodes;
}

LayerNode FrontColumns::apex(std::int32_t fan) const {
  return {GlobalNodeId{fans_.rays_of(fan).front().numbered.value() + 1}, line()[fan].wall};
}

std::vector<std::vector<LayerNode>> FrontColumns::cells_of_sector(NodeId node) const {
  const std::int32_t fan = fan_of(node);
  const auto rays = fans_.rays_of(fan);
  std::map<std::int32_t, std::vector<LayerNode>> columns;  // of the few rays that bound cells here
  const auto node_at = [&](const FanRows::Corner& corner) {
    const auto [at, is_new] = columns.try_emplace(corner.ray);
    if (is_new) at->second = column_on(rays[corner.ray]);
    return at->second[corner.ring];
  };
  std::vector<std::vector<LayerNode>> cells;
  for (const FanRows::Cell& cell : fans_.rows_of(fan).cells_after(fans_.ray_on(fan, outside_.global(node)))) {
    cells.emplace_back();
    std::ranges::transform(cell, std::back_inserter(cells.back()), node_at);
  }
  return cells;
}

std::vector<Point> FrontColumns::numbered_with(NodeId node) const {
  std::vector<Point> points{outside_.point(node)};
  if (!place_[node].valid()) return points;
  const std::vector<LayerNode>& nodes = column(node);
  for (std::size_t ring = lowest_ring(ray_at(node)); ring + 1 < nodes.size(); ++ring)
    points.push_back(nodes[ring].point);
  return points;
}

}  // namespace quadloop
