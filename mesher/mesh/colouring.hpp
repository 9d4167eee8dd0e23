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

/// Who chooses first. Scatters the numbers, so that no long chain of nodes waits one for the next.
inline std::uint64_t colouring_priority(GlobalNodeId node) { return mixed_bits(node.value() + golden_step); }

/// Nodes choose, in an order that their numbers over all ranks alone decide, the first colour that no
/// neighbour before them has (Jones and Plassmann 1993). `nodes` are the owned ones to be visited;
/// for_each_neighbour(i, visit) calls visit with the neighbours of the i-th of them, itself and repetitions
/// allowed. *Collective.*
template <class ForEachNeighbour>
Colouring colour_nodes(const Communicator& comm, const HaloMesh& mesh, std::span<const NodeId> nodes,
                       const ForEachNeighbour& for_each_neighbour) {
  constexpr std::int8_t waiting = -2;
  Colouring colouring;
  auto& colours = colouring.colour_of;
  colours.resize(mesh.points().size(), Colouring::none);
  const auto priority = [&](NodeId node) { return colouring_priority(mesh.global(node)); };
  std::vector<std::pair<std::uint64_t, std::size_t>> first;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    colours[nodes[i]] = waiting;
    first.emplace_back(priority(nodes[i]), i);
  }
  std::sort(first.begin(), first.end(), std::greater{});
  std::vector<std::size_t> order;  // those that have not chosen yet
  for (const auto& [key, i] : first) order.push_back(i);
  const auto choose = [&](std::size_t i) {
    const std::uint64_t own = priority(nodes[i]);
    std::uint64_t taken = 0;
    bool must_wait = false;
    for_each_neighbour(i, [&](NodeId other) {
      const std::int8_t colour = colours[other];
      if (colour == Colouring::none || other == nodes[i] || priority(other) < own) return;
      must_wait = must_wait || colour == waiting;
      if (colour != waiting) taken |= std::uint64_t{1} << colour;
    });
    if (must_wait) return false;
    QUADLOOP_REQUIRE(~taken != 0, "a node has fewer than 64 neighbours of different colours");
    colours[nodes[i]] = static_cast<std::int8_t>(std::countr_one(taken));
    return true;
  };
  mesh.exchange().update(colours);
  do {
    std::erase_if(order, choose);
    mesh.exchange().update(colours);
  } while (comm.any(!order.empty()));
  const auto largest = std::max_element(colours.begin(), colours.end());
  colouring.count = static_cast<std::int8_t>(
      comm.maximum(std::int64_t{largest == colours.end() ? Colouring::none : *largest}) + 1);
  return colouring;
}

}  // namespace quadloop
