#pragma once

#include <string>
#include <vector>

#include "flow/euler/scheme/flow_run.hpp"

namespace quadloop::euler {

/// How a goal of the converged flow answers to the free stream.
struct ParameterDerivative {
  double by_alpha = 0, by_mach = 0;  ///< per degree and per unit
};

/// By the goal's adjoint, which has copies: what the goal itself answers, less psi . (what the residual
/// answers), the flow being held. `boundaries` are the names of the mesh's. *Collective.*
ParameterDerivative parameter_derivative(const FlowRun& run, const std::vector<std::string>& boundaries,
                                         const Goal& goal, const std::vector<Flux>& adjoint);

}  // namespace quadloop::euler
