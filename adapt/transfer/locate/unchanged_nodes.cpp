#include "adapt/transfer/locate/unchanged_nodes.hpp"

#include <algorithm>

#include "mesher/base/id_vector.hpp"
#include "mesher/base/parallel/exchange.hpp"
#include "mesher/geometry/point_table.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop::adapt {

namespace {

constexpr std::int32_t behind = 16, ahead = 32;  ///< as refined leaves change the order
constexpr std::size_t step = ahead;  ///< distance of landmarks; more points may be removed at once

/// Every `step`-th point of a list.
std::vector<Point> landmarks(std::span<const Point> known) {
  std::vector<Point> flags;
  for (std::size_t i = 0; i < known.size(); i += step) flags.push_back(known[i]);
  return flags;
}

/// A one-to-one hash to 64 bits.
std::uint64_t scattered(GlobalNodeId node) {
  std::uint64_t bits = static_cast<std::uint64_t>(node.value()) * 0x9e3779b97f4a7c15U;
  bits = (bits ^ (bits >> 32)) * 0xd6e8feb86659fd93U;
  return bits ^ (bits >> 32);
}

/// Adds for each corner of a cell the next node and subtracts the previous one; the sum vanishes at a node
/// that is surrounded by cells.
template <std::size_t corners>
void add_turns(const Mesh& mesh, const std::array<NodeId, corners>& cell,
               IdVector<NodeId, std::uint64_t>& turns) {
  std::array<std::uint64_t, corners> bits;
  for (std::size_t k = 0; k < corners; ++k) bits[k] = scattered(mesh.global(cell[k]));
  for (std::size_t k = 0; k < corners; ++k)
    turns[cell[k]] += bits[(k + 1) % corners] - bits[(k + corners - 1) % corners];
}

/// The remaining sum at each owned node; 0 inside the mesh. *Collective.*
IdVector<NodeId, std::uint64_t> open_turns(const Communicator& comm, const Mesh& mesh) {
  IdVector<NodeId, std::uint64_t> turns(mesh.points.size(), 0);
  mesh.for_each_cell([&](const auto& cell) { add_turns(mesh, cell, turns); });
  struct Part {
    NodeId node;  ///< number on its owner
    std::uint64_t turns;
  };
  const NodeOwners owners(comm, mesh.first_node);
  Outbox<Part> parts;
  for (std::size_t copy = 0; copy < mesh.ghosts.size(); ++copy) {
    const GlobalNodeId node = mesh.ghosts[copy];
    const NodeId here{mesh.owned_nodes + static_cast<std::int32_t>(copy)};
    parts.add(owners.rank_of(node), {owners.local(node), turns[here]});
  }
  for (const Part& part : parts.deliver(comm)) turns[part.node] += part.turns;
  return turns;
}

}  // namespace

std::vector<std::int32_t> find_in_order(std::span<const Point> known, std::span<const Point> points) {
  const std::vector<Point> flags = landmarks(known);
  const PointTable landmark(flags);
  const auto count = static_cast<std::int32_t>(known.size());
  std::int32_t next = 0;  // position after the last known point found
  const auto nearby = [&](Point p) {
    for (std::int32_t i = next; i < std::min(count, next + ahead); ++i) {
      if (known[i] == p) return i;
    }
    for (std::int32_t i = next - 1; i >= std::max(0, next - behind); --i) {
      if (known[i] == p) return i;
    }
    return -1;
  };
  std::vector<std::int32_t> found;
  found.reserve(points.size());
  for (const Point p : points) {
    std::int32_t at = nearby(p);
    if (at >= 0) {
      next = std::max(next, at + 1);
    } else if (const std::int32_t mark = landmark.find(p); mark >= 0) {
      at = mark * step;
      next = at + 1;
    }
    found.push_back(at);
  }
  return found;
}

NodeFlags inner_nodes(const Communicator& comm, const Mesh& mesh) {
  const IdVector<NodeId, std::uint64_t> turns = open_turns(comm, mesh);
  NodeFlags is_inner(mesh.owned_nodes);
  for (const NodeId node : is_inner.ids()) is_inner[node] = turns[node] == 0 ? 1 : 0;
  return is_inner;
}

std::vector<std::int32_t> unchanged_nodes(const Mesh& old_mesh, const NodeFlags& is_inner,
                                          std::span<const Point> places) {
  std::vector<std::int32_t> found =
      find_in_order(std::span(old_mesh.points).first(old_mesh.owned_nodes), places);
  for (std::int32_t& node : found) {
    if (node >= 0 && is_inner[NodeId{node}] == 0) node = -1;
  }
  return found;
}

}  // namespace quadloop::adapt
