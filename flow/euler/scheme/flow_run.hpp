#pragma once

#include "flow/euler/scheme/residual.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::flow::euler {

/// A flow during its solution: the problem, which must outlive it, and the changing data.
struct FlowRun {
  const Communicator& comm;
  const EulerOptions& options;
  const DualMesh& mesh;
  const FlowModel& model;
  Residual residual;
  IdVector<NodeId, State> states;  ///< of each node
  bool is_transferred = false;     ///< whether the states are those of a given flow
};

}  // namespace quadloop::flow::euler
