#include "mesher/layers/add_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>

#include "mesher/base/error.hpp"
#include "mesher/base/exchange.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/layers/fan_rows.hpp"
#include "mesher/layers/layer_column.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

namespace {

/// A node of the new mesh, where it is known.
struct NewNode {
  GlobalNodeId id;
  Point point;
};

/// A node of the front in a fan. All ranks know all of them.
struct Ray {
  std::int32_t fan = 0;  ///< its first station
  FrontPlace place;
  GlobalNodeId before, after;  ///< the node's number without and with layers
  Point point;
};

/// A new cell or edge, with the leaf that it belongs to.
template <std::size_t width>
struct OfLeaf {
  std::int32_t leaf = 0;
  std::array<GlobalNodeId, width> nodes;
};

/// The stations of fans.
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
  /// The first station of the fan to which the place belongs, or none.
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
               const std::vector<std::vector<std::int32_t>>& edge_leaves,
               const std::function<TieRank(Point)>& divide, Mesh& mesh, std::vector<LeafRecord>& leaves)
      : comm_{comm},
        front_{front},
        line_{front.line},
        places_on_{front},
        fans_{front.line},
        edge_leaves_{edge_leaves},
        divide_{divide},
        mesh_{mesh},
        leaves_{leaves},
        owners_{comm, mesh.first_node} {}

  void build() {
    find_places();
    gather_rays();
    number_nodes();
    for (std::size_t b = 0; b < mesh_.boundaries.size(); ++b) add_boundary(b);
    refuse_bad_cells();
    put_together();
  }

 private:
  using Cell3 = OfLeaf<3>;
  using Cell4 = OfLeaf<4>;

  void find_places();
  void gather_rays();
  void number_nodes();
  void add_boundary(std::size_t b);
  void add_edge(std::size_t b, const std::array<NodeId, 2>& edge, std::int32_t leaf);
  void add_strip(NodeId from, NodeId to, std::int32_t leaf);
  void add_sector(NodeId from, std::int32_t fan, std::int32_t leaf);
  void add_ends(NodeId node, bool first, std::int32_t leaf);
  void add_cell(const std::vector<NewNode>& corners, Point of_front, std::int32_t leaf);
  void refuse_bad_cells() const;
  void put_together();
  template <std::size_t width>
  void merge_cells(std::vector<std::array<NodeId, width>>& cells, std::vector<OfLeaf<width>>& added,
                   std::int32_t LeafRecord::*count) const;
  void merge_boundaries();
  template <std::size_t width>
  std::array<GlobalNodeId, width> ids_of(const std::array<NodeId, width>& nodes) const {
    std::array<GlobalNodeId, width> ids;
    std::ranges::transform(nodes, ids.begin(), [&](NodeId node) { return after_[node]; });
    return ids;
  }
  /// On this rank, in the new mesh.
  template <std::size_t width>
  std::array<NodeId, width> numbered(const std::array<GlobalNodeId, width>& ids) const {
    std::array<NodeId, width> nodes;
    std::ranges::transform(ids, nodes.begin(), [&](GlobalNodeId id) {
      return owns(id) ? NodeId{static_cast<std::int32_t>(id.value() - first_new_)} : local_copy_.at(id);
    });
    return nodes;
  }

  bool is_front(const std::array<NodeId, 2>& edge) const {
    return places_on_.follows(place_[edge[0]], place_[edge[1]]);
  }
  int layers_of(const FrontPlace& place) const { return line_.spec(place.station).count; }
  std::int32_t fan_of(const FrontPlace& place) const { return fans_.fan_of(line_, place); }
  std::span<const Ray> rays_of(std::int32_t fan) const {
    const auto [begin, end] = std::ranges::equal_range(rays_, fan, {}, &Ray::fan);
    return {begin, end};
  }
  std::int32_t number_in_fan(std::int32_t fan, GlobalNodeId before) const {
    const auto rays = rays_of(fan);
    return static_cast<std::int32_t>(std::ranges::find(rays, before, &Ray::before) - rays.begin());
  }
  const FanRows& rows_of(std::int32_t fan) const { return fan_rows_.at(fan); }

  /// The lowest ring that belongs to the column itself.
  int lowest_ring(GlobalNodeId node, const FrontPlace& place) const {
    const std::int32_t fan = fan_of(place);
    if (fan == WallLine::none) return 0;
    const std::int32_t ray = number_in_fan(fan, node);
    return ray == 0 ? 0 : rows_of(fan).lowest_ring(ray);
  }

  /// All nodes of a column, by ring; those below its lowest ring are not to be asked for.
  std::vector<NewNode> column(const FrontPlace& place, GlobalNodeId before, GlobalNodeId after,
                              Point node) const {
    std::vector<NewNode> nodes;
    const int lowest = lowest_ring(before, place);
    for (const Point p : layer_column(front_, place, node)) {
      const int ring = static_cast<int>(nodes.size());
      nodes.push_back({ring < lowest ? GlobalNodeId{} : GlobalNodeId{after.value() + 1 + ring - lowest}, p});
    }
    nodes.push_back({after, node});
    return nodes;
  }
  std::vector<NewNode> column(NodeId node) const {
    return column(place_[node], mesh_.global(node), after_[node], mesh_.point(node));
  }

  /// The node's number on this rank in the new mesh; others' become copies.
  void use(const NewNode& node) {
    if (!owns(node.id)) copies_.emplace(node.id, node.point);
  }
  bool owns(GlobalNodeId id) const {
    return first_new_ <= id.value() && id.value() < first_new_ + owned_new_;
  }

  const Communicator& comm_;
  const LayerFront& front_;
  const WallLine& line_;
  FrontPlaces places_on_;
  Fans fans_;
  const std::vector<std::vector<std::int32_t>>& edge_leaves_;
  const std::function<TieRank(Point)>& divide_;
  Mesh& mesh_;
  std::vector<LeafRecord>& leaves_;
  NodeOwners owners_;
  IdVector<NodeId, FrontPlace> place_;
  std::vector<Ray> rays_;  ///< of all fans, in order
  std::map<std::int32_t, FanRows> fan_rows_;
  IdVector<NodeId, GlobalNodeId> after_;  ///< the new numbers of the nodes that there are
  std::int64_t first_new_ = 0;
  std::int32_t owned_new_ = 0;
  std::map<GlobalNodeId, Point> copies_;
  std::unordered_map<GlobalNodeId, NodeId> local_copy_;
  std::vector<Cell3> triangles_;
  std::vector<Cell4> quads_;
  std::vector<std::vector<OfLeaf<2>>> edges_;
  std::optional<Point> bad_;
};

/// Of the front's nodes, on the ranks that own them and on those with an edge there.
void LayerBuilder::find_places() {
  struct Asked {
    GlobalNodeId node;
    BoundaryId boundary;
  };
  place_.resize(mesh_.points.size());
  Outbox<Asked> asked;
  for (std::size_t b = 0; b < mesh_.boundaries.size(); ++b) {
    const BoundaryId boundary{static_cast<std::int32_t>(b)};
    for (const auto& edge : mesh_.boundaries[b].edges) {
      const std::array places{places_on_.locate(mesh_.point(edge[0]), boundary),
                              places_on_.locate(mesh_.point(edge[1]), boundary)};
      if (!places_on_.follows(places[0], places[1])) continue;
      for (const std::size_t k : {0, 1}) {
        place_[edge[k]] = places[k];
        const GlobalNodeId node = mesh_.global(edge[k]);
        if (!mesh_.owns(edge[k])) asked.add(owners_.rank_of(node), {node, boundary});
      }
    }
  }
  for (const Asked& a : asked.deliver(comm_)) {
    const NodeId node = owners_.local(a.node);
    place_[node] = places_on_.locate(mesh_.point(node), a.boundary);
  }
}

void LayerBuilder::gather_rays() {
  std::vector<Ray> own;
  for (const NodeId node : ids_below(NodeId{mesh_.owned_nodes})) {
    if (!place_[node].valid()) continue;
    const std::int32_t fan = fan_of(place_[node]);
    if (fan != WallLine::none) own.push_back({fan, place_[node], mesh_.global(node), {}, mesh_.point(node)});
  }
  rays_ = comm_.all_gather_values(std::span<const Ray>(own));
  std::ranges::sort(rays_, {},
                    [](const Ray& r) { return std::tuple(r.fan, r.place.station, r.place.share); });
  for (std::size_t i = 0; i < rays_.size();) {
    const std::int32_t fan = rays_[i].fan;
    const auto rays = rays_of(fan);
    std::vector<Point> directions;
    for (const Ray& ray : rays) directions.push_back(unit(ray.point - line_[fan].wall));
    fan_rows_.emplace(fan, FanRows(directions, line_.spec(fan).count));
    i += rays.size();
  }
}

/// Each node keeps its place in the order; a front node's column follows it.
void LayerBuilder::number_nodes() {
  const auto owned = ids_below(NodeId{mesh_.owned_nodes});
  std::vector<std::int32_t> counts;
  for (const NodeId node : owned) {
    const FrontPlace& place = place_[node];
    counts.push_back(1 + (place.valid() ? layers_of(place) - lowest_ring(mesh_.global(node), place) : 0));
    owned_new_ += counts.back();
  }
  first_new_ = comm_.exclusive_sum(owned_new_);
  after_.resize(mesh_.points.size());
  std::int64_t next = first_new_;
  for (const NodeId node : owned) {
    after_[node] = GlobalNodeId{next};
    next += counts[node.value()];
  }
  NodeExchange(comm_, owners_, mesh_.owned_nodes, mesh_.copies).update(after_);
  std::vector<Ray> own;
  for (const NodeId node : owned) {
    if (place_[node].valid() && fan_of(place_[node]) != WallLine::none)
      own.push_back(
          {fan_of(place_[node]), place_[node], mesh_.global(node), after_[node], mesh_.point(node)});
  }
  rays_ = comm_.all_gather_values(std::span<const Ray>(own));
  std::ranges::sort(rays_, {},
                    [](const Ray& r) { return std::tuple(r.fan, r.place.station, r.place.share); });
}

void LayerBuilder::add_boundary(std::size_t b) {
  edges_.resize(mesh_.boundaries.size());
  const auto& edges = mesh_.boundaries[b].edges;
  for (std::size_t e = 0; e < edges.size(); ++e) add_edge(b, edges[e], edge_leaves_[b][e]);
}

void LayerBuilder::add_edge(std::size_t b, const std::array<NodeId, 2>& edge, std::int32_t leaf) {
  const auto [from, to] = edge;
  if (!is_front(edge)) {
    edges_[b].push_back({leaf, {after_[from], after_[to]}});
    return;
  }
  const std::int32_t fan = fan_of(place_[from]);
  if (fan != WallLine::none && fan == fan_of(place_[to])) {
    add_sector(from, fan, leaf);
    return;
  }
  add_strip(from, to, leaf);
  const auto wall_node = [&](NodeId node) {
    const std::int32_t in = fan_of(place_[node]);
    return in == WallLine::none
               ? column(node).front()
               : NewNode{GlobalNodeId{rays_of(in).front().after.value() + 1}, line_[in].wall};
  };
  const NewNode a = wall_node(from), b_node = wall_node(to);
  use(a);
  use(b_node);
  edges_[b].push_back({leaf, {a.id, b_node.id}});
  if (line_.previous(place_[from].station) == WallLine::none && place_[from].at_station())
    add_ends(from, true, leaf);
  if (line_.next(place_[to].station) == WallLine::none) add_ends(to, false, leaf);
}

/// The cells between two columns.
void LayerBuilder::add_strip(NodeId from, NodeId to, std::int32_t leaf) {
  std::vector<NewNode> a = column(from), b = column(to);
  const auto mend_foot = [&](NodeId node, std::vector<NewNode>& nodes) {
    const std::int32_t fan = fan_of(place_[node]);
    if (fan != WallLine::none)
      nodes.front() = {GlobalNodeId{rays_of(fan).front().after.value() + 1}, line_[fan].wall};
  };
  mend_foot(from, a);
  mend_foot(to, b);
  for (std::size_t ring = 1; ring < a.size(); ++ring)
    add_cell({a[ring - 1], b[ring - 1], b[ring], a[ring]}, mesh_.point(from), leaf);
}

/// The cells of a fan that begin at the sector after a ray.
void LayerBuilder::add_sector(NodeId from, std::int32_t fan, std::int32_t leaf) {
  const auto rays = rays_of(fan);
  const auto node_at = [&](const FanRows::Corner& corner) {
    const Ray& ray = rays[corner.ring == 0 ? 0 : corner.ray];
    NewNode node = column(ray.place, ray.before, ray.after, ray.point)[corner.ring];
    if (corner.ring == 0) node.point = line_[fan].wall;
    return node;
  };
  for (const FanRows::Cell& cell : rows_of(fan).cells_after(number_in_fan(fan, mesh_.global(from)))) {
    std::vector<NewNode> corners;
    for (const FanRows::Corner& corner : cell) corners.push_back(node_at(corner));
    add_cell(corners, mesh_.point(from), leaf);
  }
}

/// The edges of the boundary on which the last column of a run lies.
void LayerBuilder::add_ends(NodeId node, bool first, std::int32_t leaf) {
  const Geometry& g = line_.geometry();
  const std::int32_t s = line_[place_[node].station].segment;
  const BoundaryId boundary = g.boundary_of(first ? g.previous(s) : g.next(s));
  const std::vector<NewNode> nodes = column(node);
  for (std::size_t ring = 1; ring < nodes.size(); ++ring) {
    const std::size_t k = first ? nodes.size() - ring : ring;
    const GlobalNodeId low = nodes[k - 1].id, high = nodes[k].id;
    edges_[boundary.value()].push_back({leaf, first ? std::array{high, low} : std::array{low, high}});
  }
}

void LayerBuilder::add_cell(const std::vector<NewNode>& corners, Point of_front, std::int32_t leaf) {
  const std::size_t n = corners.size();
  for (std::size_t k = 0; k < n; ++k) {
    use(corners[k]);
    const Point a = corners[k].point, b = corners[(k + 1) % n].point, c = corners[(k + 2) % n].point;
    if (orientation(a, b, c) <= 0 && !bad_) bad_ = of_front;
  }
  const auto id = [&](std::size_t k) { return corners[k].id; };
  if (n == 3) {
    triangles_.push_back({leaf, {id(0), id(1), id(2)}});
  } else if (!divide_) {
    quads_.push_back({leaf, {id(0), id(1), id(2), id(3)}});
  } else {
    const Point one = corners[2].point - corners[0].point, other = corners[3].point - corners[1].point;
    const double first = dot(one, one), second = dot(other, other);
    const bool takes_first =
        first != second ? first < second : divide_(corners[2].point) > divide_(corners[3].point);
    if (takes_first) {
      triangles_.push_back({leaf, {id(0), id(1), id(2)}});
      triangles_.push_back({leaf, {id(0), id(2), id(3)}});
    } else {
      triangles_.push_back({leaf, {id(0), id(1), id(3)}});
      triangles_.push_back({leaf, {id(1), id(2), id(3)}});
    }
  }
}

void LayerBuilder::refuse_bad_cells() const {
  comm_.together([&] {
    if (bad_)
      throw InputError(fmt::format(
          "near ({}, {}): a cell of the layers would be inverted; ask for a smaller spacing there", bad_->x,
          bad_->y));
  });
}

void LayerBuilder::put_together() {
  std::vector<Point> points;
  points.reserve(owned_new_);
  for (const NodeId node : ids_below(NodeId{mesh_.owned_nodes})) {
    points.push_back(mesh_.point(node));
    if (!place_[node].valid()) continue;
    const std::vector<NewNode> nodes = column(node);
    for (std::size_t ring = 0; ring + 1 < nodes.size(); ++ring) {
      if (nodes[ring].id.valid()) points.push_back(nodes[ring].point);
    }
  }
  QUADLOOP_REQUIRE(size32(points) == owned_new_, "as many nodes as are numbered");
  for (std::size_t i = mesh_.owned_nodes; i < mesh_.points.size(); ++i)
    copies_.emplace(after_[NodeId{static_cast<std::int32_t>(i)}], mesh_.points[i]);
  mesh_.copies.clear();
  for (const auto& [id, point] : copies_) {
    local_copy_.emplace(id, NodeId{size32(points)});
    mesh_.copies.push_back(id);
    points.push_back(point);
  }
  merge_boundaries();
  merge_cells(mesh_.triangles, triangles_, &LeafRecord::triangles);
  merge_cells(mesh_.quads, quads_, &LeafRecord::quads);
  for (std::size_t i = 0; i < leaves_.size(); ++i)
    leaves_[i].block = leaves_[i].triangles + leaves_[i].quads > 0 ? 1 : 0;
  mesh_.points = std::move(points);
  mesh_.first_node = first_new_;
  mesh_.owned_nodes = owned_new_;
}

/// Behind each leaf's own cells those that were added to it.
template <std::size_t width>
void LayerBuilder::merge_cells(std::vector<std::array<NodeId, width>>& cells,
                               std::vector<OfLeaf<width>>& added, std::int32_t LeafRecord::*count) const {
  std::ranges::stable_sort(added, {}, &OfLeaf<width>::leaf);
  std::vector<std::array<NodeId, width>> merged;
  merged.reserve(cells.size() + added.size());
  auto own = cells.cbegin();
  auto next = added.cbegin();
  for (std::int32_t leaf = 0; leaf < std::ssize(leaves_); ++leaf) {
    for (const auto end = own + leaves_[leaf].*count; own != end; ++own)
      merged.push_back(numbered(ids_of(*own)));
    for (; next != added.end() && next->leaf == leaf; ++next, ++(leaves_[leaf].*count))
      merged.push_back(numbered(next->nodes));
  }
  cells = std::move(merged);
}

void LayerBuilder::merge_boundaries() {
  for (std::size_t b = 0; b < edges_.size(); ++b) {
    std::ranges::stable_sort(edges_[b], {}, &OfLeaf<2>::leaf);
    mesh_.boundaries[b].edges.clear();
    for (const OfLeaf<2>& edge : edges_[b]) mesh_.boundaries[b].edges.push_back(numbered(edge.nodes));
  }
}

}  // namespace

void add_layers(const Communicator& comm, const LayerFront& front,
                const std::vector<std::vector<std::int32_t>>& edge_leaves,
                const std::function<TieRank(Point)>& divide, Mesh& mesh, std::vector<LeafRecord>& leaves) {
  LayerBuilder(comm, front, edge_leaves, divide, mesh, leaves).build();
}

}  // namespace quadloop
