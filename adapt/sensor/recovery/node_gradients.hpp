#pragma once

#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The gradient of a field at this rank's owned nodes and copies: the mean over the cells round a node,
/// weighted by their areas, of each cell's mean gradient by Green and Gauss. Exact for a linear field on any
/// cells, at the boundary too; the same bits on any number of ranks. `values` has one for each owned node and
/// copy. *Collective.*
std::vector<Point> node_gradients(const Communicator& comm, const Mesh& mesh, std::span<const double> values);

}  // namespace quadloop
