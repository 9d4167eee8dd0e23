#pragma once

#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// The gradient of a field at owned nodes and ghost copies: the area-weighted mean over the cells around a
/// node of each cell's Green-Gauss gradient. Exact for a linear field on any cells, also at the boundary; the
/// same bits on any number of ranks. `values` has one entry per owned node and ghost copy. *Collective.*
std::vector<Point> node_gradients(const Communicator& comm, const Mesh& mesh, std::span<const double> values);

}  // namespace quadloop::adapt
