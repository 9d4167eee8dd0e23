#include "mesher/layers/add_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "mesher/base/error.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/layers/fan_rows.hpp"
#include "mesher/layers/filled_interface.hpp"
#include "mesher/layers/layer_column.hpp"

namespace quadloop {

namespace {

/// A node of the layer front in a fan, known to all ranks.
struct Ray {
  std::int32_t fan = 0;  ///< first station of the fan
  FrontPlace place;
  GlobalNodeId before;  ///< the node's number before layers are added
  GrownNode front;
};

/// The fans by their stations.
class Fans {
 public:
  explicit Fans(const WallLine& line) : first_of_(line.size(), WallLine::none) {
    for (std::int32_t i = 0; i < line.size(); ++i) {
      if (line[i].shape != Station::Shape::fan) continue;
      const std::int32_t before = line.previous(i);
      const bool goes_on =
          before != WallLine::none && line[before].shape == Station::Shape::fan && line.width(before) == 0;
      first_of_[i] = goes_on && before < i ? first_of_[before] : i;
    }
  }
  /// The first station of the fan that contains the place, or none.
  std::int32_t fan_of(const WallLine& line, const FrontPlace& place) const {
    const bool beyond = !place.at_station() && line.width(place.station) > 0;
    return beyond ? WallLine::none : first_of_[place.station];
  }

 private:
  std::vector<std::int32_t> first_of_;
};

class LayerBuilder {
 public:
  LayerBuilder(const Communicator& comm, const LayerFront& front,
               std::vector<std::vector<std::int32_t>>& edge_leaves, const DivideBy& divide, Mesh& mesh,
               std::vector<LeafRecord>& leaves)
      : comm_{comm},
        front_{front},
        line_{front.line},
        places_on_{front},
        fans_{front.line},
        edge_leaves_{edge_leaves},
        mesh_{mesh} {
    place_ = places_of_nodes(comm, places_on_, mesh);
    gather_rays();
    make_rows();
    grown_.emplace(comm, nodes_below(), divide, mesh, leaves);
    gather_rays();  // again, with their new numbers
    gather_feet();
    make_columns();
  }

  void build() {
    for (std::size_t b = 0; b < mesh_.boundaries.size(); ++b) add_boundary(b);
    grown_->put_together([&](NodeId front, std::vector<Point>& points) {
      if (!place_[front].valid()) return;
      const std::vector<GrownNode>& column = columns_[front];
      for (auto node = column.begin() + lowest_ring(front); node + 1 != column.end(); ++node)
        points.push_back(node->point);
    });
    edge_leaves_ = grown_->edge_leaves();
  }

 private:
  void gather_rays();
  void make_rows();
  void gather_feet();
  void make_columns();
  std::vector<std::int32_t> nodes_below() const;
  void add_boundary(std::size_t b);
  void add_edge(std::size_t b, const std::array<NodeId, 2>& edge, std::int32_t leaf);
  void add_strip(NodeId from, NodeId to, std::int32_t leaf);
  void add_sector(NodeId from, std::int32_t fan, std::int32_t leaf);
  void add_ends(NodeId node, std::int32_t station, bool first, std::int32_t leaf);
  std::array<FrontPlace, 2> places_of(const std::array<NodeId, 2>& edge) const {
    return places_of_edge(line_, {place_[edge[0]], place_[edge[1]]});
  }
  int layers_of(const FrontPlace& place) const { return line_.spec(place.station).count; }
  std::int32_t fan_of(const FrontPlace& place) const { return fans_.fan_of(line_, place); }
  std::span<const Ray> rays_of(std::int32_t fan) const {
    return {std::ranges::lower_bound(rays_, fan, {}, &Ray::fan),
            std::ranges::upper_bound(rays_, fan, {}, &Ray::fan)};
  }
  std::int32_t number_in_fan(std::int32_t fan, GlobalNodeId before) const {
    const auto rays = rays_of(fan);
    return static_cast<std::int32_t>(std::ranges::find(rays, before, &Ray::before) - rays.begin());
  }
  const FanRows& rows_of(std::int32_t fan) const { return fan_rows_.at(fan); }

  /// Whether the column lies between one on a wall and one on an interface, so that its foot is a node of
  /// another block.
  bool stands_on_node(const FrontPlace& place) const {
    return place.at_station() && line_.is_beside_interface(place.station);
  }
  /// The lowest ring whose node the column owns.
  int lowest_ring(NodeId node) const {
    if (stands_on_node(place_[node])) return 1;
    const std::int32_t fan = fan_of(place_[node]);
    return fan == WallLine::none ? 0 : lowest_ring(fan, number_in_fan(fan, mesh_.global(node)));
  }
  int lowest_ring(std::int32_t fan, std::int32_t ray) const {
    return ray == 0 ? 0 : rows_of(fan).lowest_ring(ray);
  }

  /// All nodes of a column, by ring; it owns those from `lowest` on.
  std::vector<GrownNode> column(const FrontPlace& place, const GrownNode& front, int lowest) const {
    std::vector<GrownNode> nodes;
    for (const Point p : layer_column(front_, place, front.point)) {
      const int ring = static_cast<int>(nodes.size());
      nodes.push_back(
          {ring < lowest ? GlobalNodeId{} : GlobalNodeId{front.id.value() + 1 + ring - lowest}, p});
    }
    nodes.push_back(front);
    return nodes;
  }
  GrownNode edge_of(std::int32_t fan) const {
    return {GlobalNodeId{rays_of(fan).front().front.id.value() + 1}, line_[fan].wall};
  }

  const Communicator& comm_;
  const LayerFront& front_;
  const WallLine& line_;
  FrontPlaces places_on_;
  Fans fans_;
  std::vector<std::vector<std::int32_t>>& edge_leaves_;
  Mesh& mesh_;
  IdVector<NodeId, FrontPlace> place_;
  std::vector<Ray> rays_;  ///< of all fans, in order
  std::map<std::int32_t, FanRows> fan_rows_;
  std::map<std::int32_t, GrownNode> feet_;  ///< nodes of other blocks at the feet of columns, by station
  std::optional<GrownMesh> grown_;
  IdVector<NodeId, std::vector<GrownNode>> columns_;  ///< of front nodes, from the wall to the front
};

void LayerBuilder::gather_rays() {
  std::vector<Ray> own;
  for (const NodeId node : ids_below(NodeId{mesh_.owned_nodes})) {
    const std::int32_t fan = place_[node].valid() ? fan_of(place_[node]) : WallLine::none;
    if (fan == WallLine::none) continue;
    const GlobalNodeId number = mesh_.global(node);
    own.push_back(
        {fan, place_[node], number, grown_ ? grown_->node(node) : GrownNode{number, mesh_.point(node)}});
  }
  rays_ = comm_.all_gather_values(std::span<const Ray>(own));
  std::ranges::sort(rays_, {},
                    [](const Ray& r) { return std::tuple(r.fan, r.place.station, r.place.share); });
}

void LayerBuilder::make_rows() {
  for (std::size_t i = 0; i < rays_.size();) {
    const std::int32_t fan = rays_[i].fan;
    const auto rays = rays_of(fan);
    std::vector<Point> directions;
    for (const Ray& ray : rays) directions.push_back(unit(ray.front.point - line_[fan].wall));
    fan_rows_.emplace(fan, FanRows(directions, line_.spec(fan).count));
    i += rays.size();
  }
}

/// Number of nodes that each owned node adds in its column.
std::vector<std::int32_t> LayerBuilder::nodes_below() const {
  std::vector<std::int32_t> below;
  for (const NodeId node : ids_below(NodeId{mesh_.owned_nodes}))
    below.push_back(place_[node].valid() ? layers_of(place_[node]) - lowest_ring(node) : 0);
  return below;
}

/// The nodes of other blocks that are feet of columns.
void LayerBuilder::gather_feet() {
  struct Foot {
    std::int32_t station = 0;
    GrownNode node;
  };
  std::map<Point, std::int32_t> wanted;
  for (std::int32_t i = 0; i < line_.size(); ++i) {
    if (line_.is_beside_interface(i)) wanted.emplace(line_[i].wall, i);
  }
  std::vector<Foot> own;
  for (const NodeId node : ids_below(NodeId{wanted.empty() ? 0 : mesh_.owned_nodes})) {
    const auto found = wanted.find(mesh_.point(node));
    if (found != wanted.end()) own.push_back({found->second, grown_->node(node)});
  }
  for (const Foot& foot : comm_.all_gather_values(std::span<const Foot>(own)))
    feet_.emplace(foot.station, foot.node);
  comm_.together([&] {
    for (const auto& [point, station] : wanted) {
      if (!feet_.contains(station)) refuse_lost_foot(front_, station);
    }
  });
}

/// In a fan all columns begin at the node on the corner, which the first column owns.
void LayerBuilder::make_columns() {
  columns_.resize(mesh_.points.size());
  for (const NodeId node : columns_.ids()) {
    if (!place_[node].valid()) continue;
    columns_[node] = column(place_[node], grown_->node(node), lowest_ring(node));
    if (const std::int32_t fan = fan_of(place_[node]); fan != WallLine::none)
      columns_[node].front() = edge_of(fan);
    if (stands_on_node(place_[node])) columns_[node].front() = feet_.at(place_[node].station);
  }
}

void LayerBuilder::add_boundary(std::size_t b) {
  const auto& edges = mesh_.boundaries[b].edges;
  for (std::size_t e = 0; e < edges.size(); ++e) add_edge(b, edges[e], edge_leaves_[b][e]);
}

void LayerBuilder::add_edge(std::size_t b, const std::array<NodeId, 2>& edge, std::int32_t leaf) {
  const auto [from, to] = edge;
  const auto [first, last] = places_of(edge);
  if (!places_on_.follows(first, last)) {
    grown_->keep_edge(b, leaf, edge);
    return;
  }
  grown_->begin_block(line_.geometry().block_of(line_[first.station].segment));
  const std::int32_t fan = fan_of(first);
  if (fan != WallLine::none && fan == fan_of(last)) {
    add_sector(from, fan, leaf);
    return;
  }
  add_strip(from, to, leaf);
  grown_->add_edge(b, leaf, columns_[from].front(), columns_[to].front());
  const auto ends = [&](const FrontPlace& place) {
    return place.at_station() && !line_[place.station].at_wake;
  };
  if (line_.previous(first.station) == WallLine::none && ends(first))
    add_ends(from, first.station, true, leaf);
  if (line_.next(last.station) == WallLine::none && ends(last)) add_ends(to, last.station, false, leaf);
}

/// Adds the cells between two columns.
void LayerBuilder::add_strip(NodeId from, NodeId to, std::int32_t leaf) {
  const std::vector<GrownNode>&a = columns_[from], &b = columns_[to];
  for (std::size_t ring = 1; ring < a.size(); ++ring)
    grown_->add_cell(leaf, std::array{a[ring - 1], b[ring - 1], b[ring], a[ring]});
}

/// Adds the cells of a fan that begin at the sector after a ray.
void LayerBuilder::add_sector(NodeId from, std::int32_t fan, std::int32_t leaf) {
  const auto rays = rays_of(fan);
  std::map<std::int32_t, std::vector<GrownNode>> columns;  // the few rays that bound cells here
  const auto node_at = [&](const FanRows::Corner& corner) {
    if (corner.ring == 0) return edge_of(fan);
    const auto [at, is_new] = columns.try_emplace(corner.ray);
    const Ray& ray = rays[corner.ray];
    if (is_new) at->second = column(ray.place, ray.front, lowest_ring(fan, corner.ray));
    return at->second[corner.ring];
  };
  for (const FanRows::Cell& cell : rows_of(fan).cells_after(number_in_fan(fan, mesh_.global(from)))) {
    std::vector<GrownNode> corners;
    for (const FanRows::Corner& corner : cell) corners.push_back(node_at(corner));
    grown_->add_cell(leaf, corners);
  }
}

/// Adds the edges of the boundary on which the last column of a run lies. Of two runs that end on both sides
/// of it, one adds them.
void LayerBuilder::add_ends(NodeId node, std::int32_t station, bool first, std::int32_t leaf) {
  const Geometry& g = line_.geometry();
  const std::int32_t s = line_[station].segment, on = first ? g.previous(s) : g.next(s);
  const BoundaryId boundary = g.boundary_of(on);
  if (g.is_second(on) && !g.boundary(boundary).baffle) return;
  const std::vector<GrownNode>& nodes = columns_[node];
  for (std::size_t ring = 1; ring < nodes.size(); ++ring) {
    const std::size_t k = first ? nodes.size() - ring : ring;
    const GrownNode &low = nodes[k - 1], &high = nodes[k];
    grown_->add_edge(boundary.value(), leaf, first ? high : low, first ? low : high);
  }
}

}  // namespace

void add_layers(const Communicator& comm, const LayerFront& front,
                std::vector<std::vector<std::int32_t>>& edge_leaves, const DivideBy& divide, Mesh& mesh,
                std::vector<LeafRecord>& leaves) {
  LayerBuilder(comm, front, edge_leaves, divide, mesh, leaves).build();
}

}  // namespace quadloop
