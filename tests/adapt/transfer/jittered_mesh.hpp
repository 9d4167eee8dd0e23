#pragma once

#include "tests/mesh/grid_mesh.hpp"

namespace quadloop::test {

/// A whole mesh and the order in which it is spread.
struct WholeMesh {
  Mesh mesh;
  MeshOrder order;

  Mesh part(const Communicator& comm) const { return scatter_mesh(comm, mesh, order); }
};

/// A grid whose nodes are moved by a share of its step, spread in any order.
inline WholeMesh jittered(const Grid& grid, double share, std::uint64_t seed) {
  WholeMesh whole{grid.mesh(), {}};
  jitter(grid, share, seed, whole.mesh);
  whole.order = shuffled_order(whole.mesh, seed);
  return whole;
}

}  // namespace quadloop::test
