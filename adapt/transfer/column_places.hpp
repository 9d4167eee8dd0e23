#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// For each owned node of a new mesh the place at which an old one is to be asked for it: its own, but in
/// layers, where both have them, as high above the old wall as the node is above the new one. Two meshes cut
/// the corners of a curved wall by different chords, which may lie farther apart than the first layer is
/// high. The shift falls to 0 from the wall to the front. The same bits on any number of ranks. *Collective.*
std::vector<Point> column_places(const Communicator& comm, const Mesh& old_mesh, const Mesh& new_mesh);

}  // namespace quadloop
