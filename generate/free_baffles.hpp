#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/build/build_mesh.hpp"

namespace quadloop {

/// Divides the edges of baffles both of whose ends are free: the nodes at free ends are common to both sides
/// of a baffle, so that both sides of such an edge have the same nodes. Each side gets a node in the middle,
/// at the point of the baffle nearest to it. Returns flags of the owned nodes and ghosts that were added;
/// empty if there are none. Throws InputError with the place if a cell cannot be divided. *Collective.*
NodeFlags divide_free_baffles(const Communicator& comm, const Geometry& geometry, MeshResult& result);

}  // namespace quadloop
