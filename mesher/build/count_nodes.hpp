#pragma once

#include <cstdint>

#include "mesher/build/build_mesh.hpp"

namespace quadloop {

/// Returns the number of nodes of the mesh of build_mesh(), from its leaves and cuts, without creating cells.
/// Throws as build_mesh() does, except for boundaries that the leaves do not resolve. *Collective.*
std::int64_t count_nodes(const Communicator& comm, const Geometry& geometry, const MeshOptions& options,
                         const DemandedSplits& demanded = {});

}  // namespace quadloop
