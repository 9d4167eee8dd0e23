#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// For each owned node of a new mesh the point at which the old mesh is evaluated. It is the node's position,
/// except in layers present in both meshes, where the point has the same height above the old wall as the
/// node has above the new one. Two meshes approximate a curved wall by different chords, whose distance may
/// exceed the first layer height. The shift decreases to 0 from the wall to the outer edge of the layers. The
/// same bits on any number of ranks. *Collective.*
std::vector<Point> column_places(const Communicator& comm, const Mesh& old_mesh, const Mesh& new_mesh);

}  // namespace quadloop::adapt
