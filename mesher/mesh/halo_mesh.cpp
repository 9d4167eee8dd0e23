#include "mesher/mesh/halo_mesh.hpp"

#include <algorithm>

namespace quadloop {

namespace {

struct TravellingNode {
  GlobalNodeId node;
  Point point;
};

template <std::size_t width>
using TravellingCell = std::array<TravellingNode, width>;

struct TravellingEdge {
  GlobalNodeId from, to;
  std::int32_t boundary;
};

/// Calls `visit(i)` for the cells with a ghost node, which are few; searches blockwise at memory speed.
template <std::size_t width, class Visit>
void for_cells_at_ghosts(const std::vector<std::array<NodeId, width>>& cells, std::int32_t owned_nodes,
                         const Visit& visit) {
  constexpr std::size_t block = 256;
  const auto largest_in = [&](std::size_t begin, std::size_t end) {
    std::int32_t largest = 0;
    for (std::size_t i = begin; i < end; ++i) {
      for (const NodeId node : cells[i]) largest = std::max(largest, node.value());
    }
    return largest;
  };
  for (std::size_t begin = 0; begin < cells.size(); begin += block) {
    const std::size_t end = std::min(cells.size(), begin + block);
    if (largest_in(begin, end) < owned_nodes) continue;
    for (std::size_t i = begin; i < end; ++i) {
      if (largest_in(i, i + 1) >= owned_nodes) visit(static_cast<std::int32_t>(i));
    }
  }
}

/// Returns the other ranks that own a node of a cell or an edge.
template <class Nodes>
std::vector<int> other_owners(const Mesh& mesh, const NodeOwners& owners, const Nodes& nodes) {
  std::vector<int> ranks;
  for (const NodeId node : nodes) {
    if (!mesh.owns(node)) ranks.push_back(owners.rank_of(mesh.global(node)));
  }
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  return ranks;
}

}  // namespace

HaloMesh::HaloMesh(const Communicator& comm, const Mesh& mesh)
    : mesh_{&mesh}, points_{mesh.points}, ghosts_{mesh.ghosts}, exchange_{gather(comm)} {}

NodeExchange HaloMesh::gather(const Communicator& comm) {
  const NodeOwners owners(comm, mesh_->first_node);
  NodeTable nodes(mesh_->first_node, owned_nodes(), points_, ghosts_);
  receive_cells(comm, owners, mesh_->triangles, nodes, triangles_before_, triangles_after_, triangles_sent_);
  receive_cells(comm, owners, mesh_->quads, nodes, quads_before_, quads_after_, quads_sent_);
  receive_edges(comm, owners, nodes);
  return {comm, owners, owned_nodes(), ghosts_};
}

template <std::size_t width>
void HaloMesh::receive_cells(const Communicator& comm, const NodeOwners& owners, const Cells<width>& own,
                             NodeTable& nodes, Cells<width>& before, Cells<width>& after, Sent& sent) {
  std::vector<TravellingCell<width>> out;
  const auto send = [&](std::int32_t i) {
    for (const int rank : other_owners(*mesh_, owners, own[i])) {
      TravellingCell<width>& cell = out.emplace_back();
      for (std::size_t k = 0; k < width; ++k) cell[k] = {mesh_->global(own[i][k]), mesh_->point(own[i][k])};
      sent.cells.push_back(i);
      sent.ranks.push_back(rank);
    }
  };
  const bool any_shared = !mesh_->ghosts.empty();  // otherwise no cell touches a node of another rank
  if (any_shared) for_cells_at_ghosts(own, owned_nodes(), send);
  const Exchange exchange(comm, sent.ranks);
  const std::size_t from_lower = exchange.arrivals_before(comm.rank());
  for (const TravellingCell<width>& cell : exchange.deliver(out)) {
    auto& to = (before.size() < from_lower ? before : after).emplace_back();
    for (std::size_t k = 0; k < width; ++k) to[k] = nodes.local(cell[k].node, cell[k].point);
  }
}

void HaloMesh::receive_edges(const Communicator& comm, const NodeOwners& owners, const NodeTable& nodes) {
  Outbox<TravellingEdge> out;
  const std::int32_t boundaries = size32(mesh_->boundaries);
  for (std::int32_t boundary = 0; boundary < boundaries; ++boundary) {
    for (const auto& ends : mesh_->boundaries[boundary].edges) {
      edges_.push_back({ends[0], ends[1], boundary});
      for (const int rank : other_owners(*mesh_, owners, ends))
        out.add(rank, {mesh_->global(ends[0]), mesh_->global(ends[1]), boundary});
    }
  }
  for (const TravellingEdge& edge : out.deliver(comm))
    edges_.push_back({nodes.find(edge.from), nodes.find(edge.to), edge.boundary});
}

}  // namespace quadloop
