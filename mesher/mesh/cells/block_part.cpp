#include "mesher/mesh/cells/block_part.hpp"

#include <algorithm>
#include <utility>

#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

namespace {

/// Makes the part of one block.
class PartMaker {
 public:
  PartMaker(const Communicator& comm, const Mesh& mesh, std::int32_t block)
      : comm_{comm}, mesh_{mesh}, block_{block} {}

  /// *Collective.*
  BlockPart make() {
    add_cells(mesh_.triangles, mesh_.blocks.of_triangles, 0, part_.mesh.triangles);
    add_cells(mesh_.quads, mesh_.blocks.of_quads, size32(mesh_.triangles), part_.mesh.quads);
    add_edges();
    renumber();
    return std::move(part_);
  }

 private:
  template <class Cells>
  void add_cells(const Cells& cells, const std::vector<std::int32_t>& blocks, std::int32_t first, Cells& to) {
    for (std::int32_t i = 0; i < size32(cells); ++i) {
      if (blocks[i] != block_) continue;
      to.push_back(cells[i]);
      part_.cells.push_back(first + i);
    }
  }

  /// Adds the boundary edges that have a cell of the part to their left, in one of their two directions.
  /// Inner lines bound no part. *Collective.*
  void add_edges() {
    Mesh& mesh = part_.mesh;
    mesh.points = mesh_.points;
    mesh.first_node = mesh_.first_node;
    mesh.owned_nodes = mesh_.owned_nodes;
    mesh.ghosts = mesh_.ghosts;
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      BoundaryEdges both{boundary.name, boundary.condition, {}, boundary.layers};
      if (!boundary.inner_line) both.edges = boundary.edges;
      for (const auto& [from, to] : std::vector(both.edges)) both.edges.push_back({to, from});
      mesh.boundaries.push_back(std::move(both));
    }
    const std::vector<std::int64_t> left = edge_cells(comm_, mesh).of_boundary;
    auto cell = left.begin();
    for (BoundaryEdges& boundary : mesh.boundaries)
      std::erase_if(boundary.edges, [&](const auto&) { return *cell++ == EdgeCells::none; });
  }

  /// Flags the nodes of this rank's cells and edges, and the owned ones of other ranks' cells. *Collective.*
  NodeFlags used_nodes() const {
    NodeFlags used(mesh_.points.size(), 0);
    part_.mesh.for_each_cell([&](const auto& nodes) { flag_all(nodes, used); });
    for (const BoundaryEdges& boundary : part_.mesh.boundaries) {
      for (const auto& nodes : boundary.edges) flag_all(nodes, used);
    }
    std::vector<GlobalNodeId> ghosts;
    for_each_flagged(used, [&](NodeId node) {
      if (!mesh_.owns(node)) ghosts.push_back(mesh_.global(node));
    });
    flag_at_owners(comm_, NodeOwners(comm_, mesh_.first_node), ghosts, used);
    return used;
  }

  /// *Collective.*
  void renumber() {
    const NodeFlags used = used_nodes();
    Mesh& mesh = part_.mesh;
    mesh.points.clear();
    mesh.ghosts.clear();
    IdVector<NodeId, NodeId> number(mesh_.points.size());
    for (const NodeId node : used.ids()) {
      if (used[node] == 0) continue;
      number[node] = NodeId{size32(mesh.points)};
      mesh.points.push_back(mesh_.point(node));
      if (mesh_.owns(node)) part_.nodes.push_back(node);
    }
    mesh.owned_nodes = size32(part_.nodes);
    mesh.first_node = comm_.exclusive_sum(mesh.owned_nodes);
    std::vector<std::int64_t> global(mesh_.points.size(), 0);
    for (const NodeId node : part_.nodes) global[node.value()] = mesh.first_node + number[node].value();
    NodeExchange(comm_, NodeOwners(comm_, mesh_.first_node), mesh_.owned_nodes, mesh_.ghosts).update(global);
    for (const NodeId node : used.ids()) {
      if (used[node] != 0 && !mesh_.owns(node)) mesh.ghosts.push_back(GlobalNodeId{global[node.value()]});
    }
    const auto renumber_all = [&](auto& nodes) {
      for (NodeId& node : nodes) node = number[node];
    };
    mesh.for_each_cell(renumber_all);
    for (BoundaryEdges& boundary : mesh.boundaries) std::ranges::for_each(boundary.edges, renumber_all);
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  std::int32_t block_;
  BlockPart part_;
};

}  // namespace

std::vector<BlockPart> block_parts(const Communicator& comm, const Mesh& mesh) {
  std::vector<BlockPart> parts;
  for (std::int32_t block = 0; block < size32(mesh.blocks.names); ++block)
    parts.push_back(PartMaker(comm, mesh, block).make());
  return parts;
}

Field field_on(const BlockPart& part, const Field& field) {
  Field own{field.names, {}, field.constants, {field.cells.names, {}}};
  for (const NodeId node : part.nodes) {
    const auto row = field.row(node);
    own.values.insert(own.values.end(), row.begin(), row.end());
  }
  const std::size_t width = field.cells.width();
  for (const std::int32_t cell : part.cells) {
    const auto row = std::span(field.cells.values).subspan(cell * width, width);
    own.cells.values.insert(own.cells.values.end(), row.begin(), row.end());
  }
  return own;
}

}  // namespace quadloop
