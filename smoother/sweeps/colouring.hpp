#pragma once

#include "mesher/mesh/colouring.hpp"
#include "smoother/sweeps/node_stars.hpp"

namespace quadloop::smoother {

/// Colours of the movable nodes; nodes that share a cell have different colours. *Collective.*
inline Colouring colour_stars(const Communicator& comm, const HaloMesh& mesh, const NodeStars& stars) {
  constexpr int block_bits = 6;
  return colour_nodes(
      comm, mesh, stars.nodes(),
      [&](std::size_t i, const auto& visit) { stars.for_each_neighbour(i, visit); }, block_bits,
      [&](std::span<const std::int32_t> order, std::size_t k) { stars.fetch_corners_ahead(order, k); });
}

}  // namespace quadloop::smoother
