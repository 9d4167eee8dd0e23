#pragma once

#include <vector>

#include "adapt/metric/algebra/tensor.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Limits how fast the sizes that metrics ask for grow along a mesh's edges: by `slope` for each unit of
/// length and of metric length (grown()), from every node on. Only ever asks for smaller sizes. `metrics` has
/// one for each owned node and copy. The same bits on any number of ranks. *Collective.*
void limit_growth(const Communicator& comm, const Mesh& mesh, double slope, std::vector<Metric>& metrics);

}  // namespace quadloop
