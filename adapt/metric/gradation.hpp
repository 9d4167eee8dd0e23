#pragma once

#include <vector>

#include "adapt/metric/algebra/tensor.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// Limits the growth of metric sizes along a mesh's edges to `slope` per unit of length and of metric length
/// (grown()), from every node. Only reduces sizes. `metrics` has one entry per owned node and ghost copy. The
/// same bits on any number of ranks. *Collective.*
void limit_growth(const Communicator& comm, const Mesh& mesh, double slope, std::vector<Metric>& metrics);

}  // namespace quadloop::adapt
