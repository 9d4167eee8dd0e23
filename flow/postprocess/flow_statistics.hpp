#pragma once

#include <optional>
#include <vector>

#include "flow/postprocess/boundary_forces.hpp"
#include "flow/postprocess/goal_value.hpp"
#include "flow/postprocess/unsteady_flow.hpp"

namespace quadloop::flow {

/// Results of a flow other than its coefficients.
struct FlowTables {
  std::vector<BoundaryForce> forces;     ///< of each boundary with a force
  std::optional<UnsteadyFlow> unsteady;  ///< if flow and forces are time averages
  std::vector<GoalValue> goals;          ///< output functionals with error estimates
};

/// Results of a flow, for any solver.
struct FlowStatistics : FlowTables {
  std::optional<double> cl, cd, residual;  ///< if the solver provides them
  std::optional<double> log_residual;      ///< base-10 logarithm of the residual in the solver's units
  std::optional<bool> converged;           ///< whether the solver met its own criterion, if it reports this
};

}  // namespace quadloop::flow
