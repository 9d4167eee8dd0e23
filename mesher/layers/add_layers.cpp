#include "mesher/layers/add_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "mesher/base/error.hpp"
#include "mesher/layers/layer_cells.hpp"

namespace quadloop {

namespace {

/// The mesh outside and the cells of its layers, put together to one.
class JoinedMesh {
 public:
  JoinedMesh(const FrontColumns& columns, const Mesh& outside) : columns_{columns}, outside_{outside} {}

  Mesh join(LayerCells& cells, std::vector<LeafRecord>& leaves) {
    take_nodes(cells.foreign);
    take_edges(cells.edges);
    take_cells(outside_.triangles, cells.triangles, leaves, &LeafRecord::triangles, mesh_.triangles);
    take_cells(outside_.quads, cells.quads, leaves, &LeafRecord::quads, mesh_.quads);
    for (LeafRecord& leaf : leaves) leaf.block = leaf.triangles + leaf.quads > 0 ? 1 : 0;
    return std::move(mesh_);
  }

 private:
  void take_nodes(std::map<GlobalNodeId, Point>& foreign);
  void take_edges(std::vector<std::vector<OfLeaf<2>>>& edges);
  template <std::size_t width>
  void take_cells(const std::vector<std::array<NodeId, width>>& cells, std::vector<OfLeaf<width>>& added,
                  std::vector<LeafRecord>& leaves, std::int32_t LeafRecord::*count,
                  std::vector<std::array<NodeId, width>>& joined) const;

  NodeId local(GlobalNodeId id) const {
    return columns_.owns(id) ? NodeId{static_cast<std::int32_t>(id.value() - mesh_.first_node)}
                             : local_copy_.at(id);
  }

  const FrontColumns& columns_;
  const Mesh& outside_;
  Mesh mesh_;
  std::unordered_map<GlobalNodeId, NodeId> local_copy_;
};

void JoinedMesh::take_nodes(std::map<GlobalNodeId, Point>& foreign) {
  mesh_.first_node = columns_.first_node();
  mesh_.owned_nodes = columns_.owned_nodes();
  mesh_.points.reserve(mesh_.owned_nodes);
  for (const NodeId node : ids_below(NodeId{outside_.owned_nodes})) {
    for (const Point p : columns_.numbered_with(node)) mesh_.points.push_back(p);
  }
  QUADLOOP_REQUIRE(size32(mesh_.points) == mesh_.owned_nodes, "as many nodes as are numbered");
  for (std::int32_t i = outside_.owned_nodes; i < size32(outside_.points); ++i)
    foreign.emplace(columns_.numbered(NodeId{i}), outside_.point(NodeId{i}));
  for (const auto& [id, point] : foreign) {
    local_copy_.emplace(id, NodeId{size32(mesh_.points)});
    mesh_.copies.push_back(id);
    mesh_.points.push_back(point);
  }
}

void JoinedMesh::take_edges(std::vector<std::vector<OfLeaf<2>>>& edges) {
  for (std::size_t b = 0; b < edges.size(); ++b) {
    std::ranges::stable_sort(edges[b], {}, &OfLeaf<2>::leaf);
    const BoundaryEdges& boundary = outside_.boundaries[b];
    mesh_.boundaries.push_back({boundary.name, boundary.condition, {}});
    for (const OfLeaf<2>& edge : edges[b])
      mesh_.boundaries[b].edges.push_back({local(edge.nodes[0]), local(edge.nodes[1])});
  }
}

/// Behind each leaf's own cells those that were added to it.
template <std::size_t width>
void JoinedMesh::take_cells(const std::vector<std::array<NodeId, width>>& cells,
                            std::vector<OfLeaf<width>>& added, std::vector<LeafRecord>& leaves,
                            std::int32_t LeafRecord::*count,
                            std::vector<std::array<NodeId, width>>& joined) const {
  std::ranges::stable_sort(added, {}, &OfLeaf<width>::leaf);
  joined.reserve(cells.size() + added.size());
  auto own = cells.cbegin();
  auto next = added.cbegin();
  for (std::int32_t leaf = 0; leaf < size32(leaves); ++leaf) {
    for (const auto end = own + leaves[leaf].*count; own != end; ++own) {
      std::array<NodeId, width>& cell = joined.emplace_back();
      std::ranges::transform(*own, cell.begin(), [&](NodeId n) { return local(columns_.numbered(n)); });
    }
    for (; next != added.end() && next->leaf == leaf; ++next, ++(leaves[leaf].*count)) {
      std::array<NodeId, width>& cell = joined.emplace_back();
      std::ranges::transform(next->nodes, cell.begin(), [&](GlobalNodeId id) { return local(id); });
    }
  }
}

}  // namespace

void add_layers(const Communicator& comm, const LayerFront& front,
                const std::vector<std::vector<std::int32_t>>& edge_leaves,
                const std::function<TieRank(Point)>& divide, Mesh& mesh, std::vector<LeafRecord>& leaves) {
  const FrontColumns columns(comm, front, mesh);
  LayerCells cells = layer_cells(columns, mesh, edge_leaves, divide);
  comm.together([&] {
    if (cells.bad)
      throw InputError(fmt::format(
          "near ({}, {}): a cell of the layers would be inverted; ask for a smaller spacing there",
          cells.bad->x, cells.bad->y));
  });
  mesh = JoinedMesh(columns, mesh).join(cells, leaves);
}

}  // namespace quadloop
