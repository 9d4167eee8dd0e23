#include "mesher/mesh/halo_mesh.hpp"

#include <algorithm>
#include <compare>
#include <iterator>

#include "mesher/mesh/periodic_mesh.hpp"

namespace quadloop {

namespace {

struct TravellingNode {
  GlobalNodeId image;
  Point original;  ///< its position
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

/// Where a cell or an edge is needed: the rank, and the shift that takes it to that rank's node.
struct Destination {
  int rank;
  PeriodicShift shift;
  friend auto operator<=>(const Destination&, const Destination&) = default;
};

/// Returns where a cell or an edge is needed other than in its place on this rank.
template <class Nodes>
std::vector<Destination> destinations(const Mesh& mesh, const NodeOwners& owners, const Nodes& nodes) {
  std::vector<Destination> found;
  for (const NodeId node : nodes) {
    if (mesh.owns(node)) continue;
    const GlobalNodeId image = mesh.global(node);
    found.push_back({owners.rank_of(original_of(image)), -shift_of(image)});
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace

HaloMesh::HaloMesh(const Communicator& comm, const Mesh& mesh) : HaloMesh(comm, mesh, nullptr) {}

Point HaloMesh::original(NodeId node) const {
  return joined_ != nullptr ? joined_->originals[node.value()] : mesh_->point(node);
}

GlobalNodeId HaloMesh::number_of_original(NodeId node) const { return original_of(image(node)); }

HaloMesh::HaloMesh(const Communicator& comm, const PeriodicMesh& joined)
    : HaloMesh(comm, joined.mesh, &joined) {}

HaloMesh::HaloMesh(const Communicator& comm, const Mesh& mesh, const PeriodicMesh* joined)
    : mesh_{&mesh}, joined_{joined}, points_{mesh.points}, ghosts_{mesh.ghosts}, exchange_{gather(comm)} {}

NodeExchange HaloMesh::gather(const Communicator& comm) {
  const NodeOwners owners(comm, mesh_->first_node);
  NodeTable nodes(mesh_->first_node, owned_nodes(), points_, ghosts_);
  receive_cells<3>(comm, owners, mesh_->triangles, nodes,
                   {triangles_before_, triangles_after_, triangles_moved_}, triangles_sent_);
  receive_cells<4>(comm, owners, mesh_->quads, nodes, {quads_before_, quads_after_, quads_moved_},
                   quads_sent_);
  receive_edges(comm, owners, nodes);
  std::vector<GlobalNodeId> originals;
  std::ranges::transform(ghosts_, std::back_inserter(originals), original_of);
  return {comm, owners, owned_nodes(), originals};
}

Point HaloMesh::place(GlobalNodeId image, Point original) const {
  const PeriodicShift shift = shift_of(image);
  return shift == 0 ? original : joined_->maps.image(shift, original);
}

template <std::size_t width>
void HaloMesh::receive_cells(const Communicator& comm, const NodeOwners& owners, const Cells<width>& own,
                             NodeTable& nodes, const CellsOfOthers<width>& received, SentOfKind& sent) {
  std::vector<TravellingCell<width>> out, moved_out;
  const auto send = [&](std::int32_t i) {
    for (const auto& [rank, shift] : destinations(*mesh_, owners, own[i])) {
      TravellingCell<width> cell;
      for (std::size_t k = 0; k < width; ++k)
        cell[k] = {shifted(mesh_->global(own[i][k]), shift), original(own[i][k])};
      (shift == 0 ? out : moved_out).push_back(cell);
      (shift == 0 ? sent.in_place : sent.moved).add(i, rank);
    }
  };
  const bool any_shared = !mesh_->ghosts.empty();  // otherwise no cell touches a node of another rank
  if (any_shared) for_cells_at_ghosts(own, owned_nodes(), send);
  const auto append = [&](const TravellingCell<width>& cell, Cells<width>& cells) {
    auto& to = cells.emplace_back();
    for (std::size_t k = 0; k < width; ++k)
      to[k] = nodes.local(cell[k].image, place(cell[k].image, cell[k].original));
  };
  const Exchange exchange(comm, sent.in_place.ranks);
  const std::size_t from_lower = exchange.arrivals_before(comm.rank());
  for (const TravellingCell<width>& cell : exchange.deliver(out))
    append(cell, received.before.size() < from_lower ? received.before : received.after);
  if (joined_ == nullptr) return;
  for (const TravellingCell<width>& cell : Exchange(comm, sent.moved.ranks).deliver(moved_out))
    append(cell, received.moved);
}

void HaloMesh::receive_edges(const Communicator& comm, const NodeOwners& owners, const NodeTable& nodes) {
  Outbox<TravellingEdge> out, moved_out;
  const std::int32_t boundaries = size32(mesh_->boundaries);
  for (std::int32_t boundary = 0; boundary < boundaries; ++boundary) {
    const bool of_pair = joined_ != nullptr && joined_->opposite[boundary].exists();
    for (const auto& ends : mesh_->boundaries[boundary].edges) {
      edges_.push_back({ends[0], ends[1], boundary});
      for (const auto& [rank, shift] : destinations(*mesh_, owners, ends)) {
        if (of_pair && shift != 0) continue;
        (shift == 0 ? out : moved_out)
            .add(rank,
                 {shifted(mesh_->global(ends[0]), shift), shifted(mesh_->global(ends[1]), shift), boundary});
      }
    }
  }
  const auto append = [&](const TravellingEdge& edge) {
    edges_.push_back({nodes.find(edge.from), nodes.find(edge.to), edge.boundary});
  };
  std::ranges::for_each(out.deliver(comm), append);
  in_place_ = edges_.size();
  if (joined_ != nullptr) std::ranges::for_each(moved_out.deliver(comm), append);
}

void HaloMesh::update_points() {
  exchange_.update(points_);
  if (joined_ == nullptr) return;
  for (const NodeId node : ids_between(NodeId{owned_nodes()}, NodeId{size32(points_)}))
    points_[node.value()] = place(node, points_[node.value()]);
}

}  // namespace quadloop
