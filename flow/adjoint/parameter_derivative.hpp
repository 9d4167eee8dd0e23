#pragma once

#include <string>
#include <vector>

#include "flow/euler/scheme/flow_run.hpp"

namespace quadloop::flow::euler {

/// Derivatives of an output functional of the converged flow with respect to the free stream.
struct ParameterDerivative {
  double by_alpha = 0, by_mach = 0;  ///< per degree and per unit
};

/// Uses the functional's adjoint, which must include ghosts: the derivative of the functional minus psi .
/// (derivative of the residual), at constant states. `boundaries` are the names of the mesh's boundaries.
/// *Collective.*
ParameterDerivative parameter_derivative(const FlowRun& run, const std::vector<std::string>& boundaries,
                                         const Goal& goal, const IdVector<NodeId, Flux>& adjoint);

}  // namespace quadloop::flow::euler
