#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/base/mixed_bits.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop {

/// Colours for nodes that are to be visited, no two neighbours the same, so that all of one colour can be
/// visited at once.
struct Colouring {
  /// Of each node, owned and copies; none for those that are not visited.
  IdVector<NodeId, std::int8_t> colour_of;
  std::int8_t count = 0;  ///< over all ranks
  static constexpr std::int8_t none = -1;
};

/// Where what is visited needs little.
struct NothingToFetch {
  void operator()(std::span<const std::int32_t> /*order*/, std::size_t /*k*/) const {}
};

/// Who chooses first: blocks of 2^`block_bits` numbers in a scattered order, so that no long chain of nodes
/// waits one for the next over many ranks; in a block the higher number.
class ColouringPriority {
 public:
  ColouringPriority(GlobalNodeId node, int block_bits)
      : number_{static_cast<std::uint64_t>(node.value()) >> block_bits}, node_{node} {}
  std::uint64_t block() const { return mixed_bits(number_ + golden_step); }
  friend auto operator<=>(const ColouringPriority& a, const ColouringPriority& b) {
    return a.number_ == b.number_ ? a.node_ <=> b.node_ : a.block() <=> b.block();
  }

 private:
  std::uint64_t number_;  ///< of the block
  GlobalNodeId node_;
};

/// The indices of `nodes`, which ascend, those that choose first in front.
inline std::vector<std::int32_t> order_of_choice(const HaloMesh& mesh, std::span<const NodeId> nodes,
                                                 int block_bits) {
  const auto priority = [&](std::size_t i) { return ColouringPriority(mesh.global(nodes[i]), block_bits); };
  std::vector<std::pair<std::uint64_t, std::int32_t>> blocks;  // with the index of the first node
  for (std::int32_t i = 0; i < std::ssize(nodes); ++i) {
    const std::uint64_t block = priority(i).block();
    if (blocks.empty() || blocks.back().first != block) blocks.emplace_back(block, i);
  }
  std::sort(blocks.begin(), blocks.end(), std::greater{});
  std::vector<std::int32_t> order;
  order.reserve(nodes.size());
  for (const auto& [block, first] : blocks) {
    std::int32_t end = first;
    while (end < std::ssize(nodes) && priority(end).block() == block) ++end;
    while (end > first) order.push_back(--end);
  }
  return order;
}

/// Nodes choose, in an order that their numbers over all ranks alone decide, the first colour that no
/// neighbour before them has (Jones and Plassmann 1993). `nodes` are the owned ones to be visited, ascending;
/// for_each_neighbour(i, visit) calls visit with the neighbours of the i-th of them, itself and repetitions
/// allowed. `block_bits` as in ColouringPriority: with some, nodes close by choose one after the other, which
/// is faster. `fetch_ahead(order, k)` comes before the neighbours of nodes[order[k]] are asked for.
/// *Collective.*
template <class ForEachNeighbour, class FetchAhead = NothingToFetch>
Colouring colour_nodes(const Communicator& comm, const HaloMesh& mesh, std::span<const NodeId> nodes,
                       const ForEachNeighbour& for_each_neighbour, int block_bits = 0,
                       const FetchAhead& fetch_ahead = {}) {
  constexpr std::int8_t waiting = -2, passed_over = -3;
  Colouring colouring;
  auto& colours = colouring.colour_of;
  colours.resize(mesh.points().size(), Colouring::none);
  const auto priority = [&](NodeId node) { return ColouringPriority(mesh.global(node), block_bits); };
  for (const NodeId node : nodes) colours[node] = waiting;
  std::vector<std::int32_t> order =
      order_of_choice(mesh, nodes, block_bits);  // those that have not chosen yet
  const auto must_wait = [&](std::size_t i) {
    const ColouringPriority own = priority(nodes[i]);
    bool must = false;
    for_each_neighbour(i, [&](NodeId other) {  // this rank's that wait come later
      const std::int8_t colour = colours[other];
      if (colour == passed_over || (colour == waiting && !mesh.owns(other)))
        must = must || priority(other) > own;
    });
    return must;
  };
  const auto choose = [&](std::size_t i) {
    std::uint64_t taken = 0;
    bool may_wait = false;
    for_each_neighbour(i, [&](NodeId other) {  // no branch hangs on colours, which cannot be foreseen
      const std::int8_t colour = colours[other];
      taken |= std::uint64_t{colour >= 0} << (colour & 63);  // so it went before: it has not waited
      may_wait = may_wait | (colour == passed_over) | !mesh.owns(other);
    });
    if (may_wait && must_wait(i)) {
      colours[nodes[i]] = passed_over;
      return false;
    }
    QUADLOOP_REQUIRE(~taken != 0, "a node has fewer than 64 neighbours of different colours");
    colours[nodes[i]] = static_cast<std::int8_t>(std::countr_one(taken));
    return true;
  };
  mesh.exchange().update(colours);
  do {
    std::size_t waiting_now = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
      fetch_ahead(order, k);
      if (!choose(order[k])) order[waiting_now++] = order[k];
    }
    order.resize(waiting_now);
    mesh.exchange().update(colours);
  } while (comm.any(!order.empty()));
  std::int8_t largest = Colouring::none;
  for (const NodeId node : nodes) largest = std::max(largest, colours[node]);
  colouring.count = static_cast<std::int8_t>(comm.maximum(std::int64_t{largest}) + 1);
  return colouring;
}

}  // namespace quadloop
