#pragma once

#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop::smoother {

/// Flags the nodes of cells with a flagged node, `rings` times. On entry flags are read at owned nodes only;
/// on return they are valid at all nodes. *Collective.*
inline void grow(const HaloMesh& mesh, NodeFlags& flags, int rings) {
  for (int ring = 0; ring < rings; ++ring) {
    mesh.exchange().update(flags);
    const NodeFlags before = flags;
    mesh.for_each_cell([&](const auto& nodes) {
      char any = 0;
      for (const NodeId node : nodes) any |= before[node];  // no branches, as flags are unpredictable
      for (const NodeId node : nodes) flags[node] |= any;
    });
  }
  mesh.exchange().update(flags);
}

}  // namespace quadloop::smoother
