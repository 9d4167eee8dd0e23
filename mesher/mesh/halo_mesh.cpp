#include "mesher/mesh/halo_mesh.hpp"

#include <algorithm>
#include <unordered_map>

namespace quadloop {

namespace {

struct TravellingNode {
  std::int64_t number;
  Point point;
};

template <std::size_t width>
using TravellingCell = std::array<TravellingNode, width>;

struct TravellingEdge {
  std::int64_t from, to;
  std::int32_t boundary;
};

/// The ranks other than this one that own a node of a cell or an edge.
template <class Nodes>
std::vector<int> other_owners(const Mesh& mesh, const NodeOwners& owners, const Nodes& nodes) {
  std::vector<int> ranks;
  for (const NodeId node : nodes) {
    if (node.value() >= mesh.owned_nodes) ranks.push_back(owners.rank_of(mesh.global(node)));
  }
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  return ranks;
}

}  // namespace

/// This rank's numbers of nodes; it gives new ones to nodes that it meets for the first time.
class HaloMesh::Numbering {
 public:
  explicit Numbering(HaloMesh& halo) : halo_{halo} {
    for (std::size_t i = 0; i < halo.copies_.size(); ++i) {
      local_.emplace(halo.copies_[i].value(), halo.owned_nodes() + static_cast<std::int32_t>(i));
    }
  }

  NodeId find(std::int64_t number) const {
    const std::int64_t offset = number - halo_.mesh_->first_node;
    if (0 <= offset && offset < halo_.owned_nodes()) return NodeId{static_cast<std::int32_t>(offset)};
    const auto found = local_.find(number);
    return found == local_.end() ? NodeId{} : NodeId{found->second};
  }

  NodeId find_or_add(const TravellingNode& node) {
    const NodeId known = find(node.number);
    if (known.valid()) return known;
    const auto added = static_cast<std::int32_t>(halo_.points_.size());
    local_.emplace(node.number, added);
    halo_.points_.push_back(node.point);
    halo_.copies_.push_back(GlobalNodeId{node.number});
    return NodeId{added};
  }

 private:
  HaloMesh& halo_;
  std::unordered_map<std::int64_t, std::int32_t> local_;
};

HaloMesh::HaloMesh(const Communicator& comm, const Mesh& mesh)
    : mesh_{&mesh}, points_{mesh.points}, copies_{mesh.copies}, exchange_{gather(comm)} {}

std::int64_t HaloMesh::global(std::int32_t node) const {
  if (node < owned_nodes()) return mesh_->first_node + node;
  return copies_[static_cast<std::size_t>(node - owned_nodes())].value();
}

NodeExchange HaloMesh::gather(const Communicator& comm) {
  const NodeOwners owners(comm, mesh_->first_node);
  Numbering numbering(*this);
  receive_cells(comm, owners, mesh_->triangles, numbering, triangles_before_, triangles_after_,
                triangles_sent_);
  receive_cells(comm, owners, mesh_->quads, numbering, quads_before_, quads_after_, quads_sent_);
  receive_edges(comm, owners, numbering);
  return {comm, owners, owned_nodes(), copies_};
}

template <std::size_t width>
void HaloMesh::receive_cells(const Communicator& comm, const NodeOwners& owners, const Cells<width>& own,
                             Numbering& numbering, Cells<width>& before, Cells<width>& after,
                             CellLists& sent) {
  std::vector<std::vector<TravellingCell<width>>> out(static_cast<std::size_t>(comm.size()));
  sent.resize(out.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    const auto& nodes = own[i];
    for (const int rank : other_owners(*mesh_, owners, nodes)) {
      TravellingCell<width> cell;
      for (std::size_t k = 0; k < width; ++k)
        cell[k] = {mesh_->global(nodes[k]).value(), mesh_->point(nodes[k])};
      out[static_cast<std::size_t>(rank)].push_back(cell);
      sent[static_cast<std::size_t>(rank)].push_back(static_cast<std::int32_t>(i));
    }
  }
  const auto received = comm.exchange(out);
  for (std::size_t rank = 0; rank < received.size(); ++rank) {
    Cells<width>& cells = static_cast<int>(rank) < comm.rank() ? before : after;
    for (const TravellingCell<width>& cell : received[rank]) {
      std::array<NodeId, width> nodes;
      for (std::size_t k = 0; k < width; ++k) nodes[k] = numbering.find_or_add(cell[k]);
      cells.push_back(nodes);
    }
  }
}

void HaloMesh::receive_edges(const Communicator& comm, const NodeOwners& owners, const Numbering& numbering) {
  std::vector<std::vector<TravellingEdge>> out(static_cast<std::size_t>(comm.size()));
  for (std::size_t b = 0; b < mesh_->boundaries.size(); ++b) {
    for (const auto& nodes : mesh_->boundaries[b].edges) {
      edges_.push_back({nodes[0], nodes[1], static_cast<std::int32_t>(b)});
      for (const int rank : other_owners(*mesh_, owners, nodes)) {
        out[static_cast<std::size_t>(rank)].push_back(
            {mesh_->global(nodes[0]).value(), mesh_->global(nodes[1]).value(), static_cast<std::int32_t>(b)});
      }
    }
  }
  for (const auto& from_rank : comm.exchange(out)) {
    for (const TravellingEdge& edge : from_rank)
      edges_.push_back({numbering.find(edge.from), numbering.find(edge.to), edge.boundary});
  }
}

}  // namespace quadloop
