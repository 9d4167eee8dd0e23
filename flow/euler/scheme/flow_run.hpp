#pragma once

#include <vector>

#include "flow/euler/scheme/residual.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::euler {

/// A flow while it is solved: what it is solved on, which must outlive it, and what changes meanwhile.
struct FlowRun {
  const Communicator& comm;
  const EulerOptions& options;
  const DualMesh& mesh;
  const FlowModel& model;
  Residual residual;
  std::vector<State> states;  ///< of each node
  bool is_carried = false;    ///< the states are those of a flow that was given
};

}  // namespace quadloop::euler
