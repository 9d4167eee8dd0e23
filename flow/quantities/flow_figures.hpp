#pragma once

#include <optional>
#include <vector>

#include "flow/quantities/boundary_forces.hpp"
#include "flow/quantities/goal_value.hpp"
#include "flow/quantities/unsteady_flow.hpp"

namespace quadloop {

/// Results of a flow other than its coefficients.
struct FlowTables {
  std::vector<BoundaryForce> forces;     ///< of each boundary with a force
  std::optional<UnsteadyFlow> unsteady;  ///< if flow and forces are time averages
  std::vector<GoalValue> goals;          ///< output functionals with error estimates
};

/// Results of a flow, for any solver.
struct FlowFigures : FlowTables {
  std::optional<double> cl, cd, residual;  ///< if the solver provides them
};

}  // namespace quadloop
