#pragma once

#include <cstdint>

#include "mesher/build/build_mesh.hpp"

namespace quadloop {

/// How many nodes the mesh would have that build_mesh() makes: from its leaves and from what is cut, without
/// making cells of them. Throws as that does, but for boundaries that leaves would not show. *Collective.*
std::int64_t count_nodes(const Communicator& comm, const Geometry& geometry, const MeshOptions& options,
                         const DemandedSplits& demanded = {});

}  // namespace quadloop
