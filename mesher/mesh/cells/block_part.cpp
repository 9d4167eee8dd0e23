#include "mesher/mesh/cells/block_part.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"

namespace quadloop {

namespace {

constexpr std::int32_t no_block = -1;

}  // namespace

BlockCutter::BlockCutter(const Communicator& comm, const Mesh& mesh, const MeshBlocks& blocks)
    : comm_{comm},
      mesh_{mesh},
      blocks_{blocks},
      owners_(comm, mesh.first_node),
      ghosts_(comm, owners_, mesh.owned_nodes, mesh.ghosts),
      left_{blocks_of(edge_cells(comm, mesh).of_boundary)},
      right_{blocks_of(cells_right_of_boundaries(comm, mesh))} {}

BlockPart BlockCutter::cut(std::int32_t block) const {
  BlockPart part;
  take_cells(block, part);
  take_edges(block, part.mesh);
  take_nodes(part);
  return part;
}

/// Returns the block of each cell, by global cell numbers; `no_block` for EdgeCells::none. *Collective.*
std::vector<std::int32_t> BlockCutter::blocks_of(const std::vector<std::int64_t>& cells) const {
  std::vector<std::int32_t> own = blocks_.of_triangles;
  own.insert(own.end(), blocks_.of_quads.begin(), blocks_.of_quads.end());
  std::vector<std::int64_t> wanted;
  for (const std::int64_t cell : cells) {
    if (cell != EdgeCells::none) wanted.push_back(cell);
  }
  const std::vector<std::int32_t> found =
      rows_of_cells(comm_, CellOwners(comm_, mesh_), std::span<const std::int64_t>(wanted), own);
  std::vector<std::int32_t> all;
  auto next = found.begin();
  for (const std::int64_t cell : cells) all.push_back(cell == EdgeCells::none ? no_block : *next++);
  return all;
}

/// Takes the block's cells, still with the nodes of the whole mesh.
void BlockCutter::take_cells(std::int32_t block, BlockPart& part) const {
  const auto take = [&](const auto& cells, const std::vector<std::int32_t>& blocks, std::int32_t first,
                        auto& to) {
    for (std::int32_t i = 0; i < size32(cells); ++i) {
      if (blocks[i] != block) continue;
      to.push_back(cells[i]);
      part.cells.push_back(first + i);
    }
  };
  take(mesh_.triangles, blocks_.of_triangles, 0, part.mesh.triangles);
  take(mesh_.quads, blocks_.of_quads, size32(mesh_.triangles), part.mesh.quads);
}

/// Takes the boundary edges beside the block, still with the nodes of the whole mesh.
void BlockCutter::take_edges(std::int32_t block, Mesh& part) const {
  std::size_t at = 0;
  for (const BoundaryEdges& boundary : mesh_.boundaries) {
    BoundaryEdges& own = part.boundaries.emplace_back(
        BoundaryEdges{boundary.name, boundary.condition, {}, boundary.layers, false, boundary.inner_line});
    for (const auto& [from, to] : boundary.edges) {
      if (left_[at] == block)
        own.edges.push_back({from, to});
      else if (right_[at] == block)
        own.edges.push_back({to, from});
      ++at;
    }
  }
}

/// Flags the nodes of this rank's cells and edges, and the owned ones of other ranks' cells. *Collective.*
NodeFlags BlockCutter::nodes_used_by(const Mesh& part) const {
  NodeFlags used(mesh_.points.size(), 0);
  part.for_each_cell([&](const auto& nodes) { flag_all(nodes, used); });
  for (const BoundaryEdges& boundary : part.boundaries) {
    for (const auto& nodes : boundary.edges) flag_all(nodes, used);
  }
  std::vector<GlobalNodeId> ghosts;
  for_each_flagged(used, [&](NodeId node) {
    if (!mesh_.owns(node)) ghosts.push_back(mesh_.global(node));
  });
  flag_at_owners(comm_, owners_, ghosts, used);
  return used;
}

/// Takes the nodes of the block and numbers them anew. *Collective.*
void BlockCutter::take_nodes(BlockPart& part) const {
  const NodeFlags used = nodes_used_by(part.mesh);
  Mesh& mesh = part.mesh;
  IdVector<NodeId, NodeId> number(mesh_.points.size());
  for (const NodeId node : used.ids()) {
    if (used[node] == 0) continue;
    number[node] = NodeId{size32(mesh.points)};
    mesh.points.push_back(mesh_.point(node));
    if (mesh_.owns(node)) part.nodes.push_back(node);
  }
  mesh.owned_nodes = size32(part.nodes);
  mesh.first_node = comm_.exclusive_sum(std::int64_t{mesh.owned_nodes});
  std::vector<std::int64_t> global(mesh_.points.size(), 0);
  for (const NodeId node : part.nodes) global[node.value()] = mesh.first_node + number[node].value();
  ghosts_.update(global);
  for (const NodeId node : used.ids()) {
    if (used[node] != 0 && !mesh_.owns(node)) mesh.ghosts.push_back(GlobalNodeId{global[node.value()]});
  }
  const auto renumber_all = [&](auto& nodes) {
    for (NodeId& node : nodes) node = number[node];
  };
  mesh.for_each_cell(renumber_all);
  for (BoundaryEdges& boundary : mesh.boundaries) std::ranges::for_each(boundary.edges, renumber_all);
}

std::vector<BlockPart> block_parts(const Communicator& comm, const Mesh& mesh) {
  std::vector<BlockPart> parts;
  const BlockCutter cutter(comm, mesh, mesh.blocks);
  for (std::int32_t block = 0; block < size32(mesh.blocks.names); ++block) parts.push_back(cutter.cut(block));
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
