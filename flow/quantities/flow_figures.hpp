#pragma once

#include <optional>
#include <vector>

#include "flow/quantities/boundary_forces.hpp"
#include "flow/quantities/goal_value.hpp"
#include "flow/quantities/unsteady_flow.hpp"

namespace quadloop {

/// What a flow came to beside its coefficients.
struct FlowTables {
  std::vector<BoundaryForce> forces;     ///< of each boundary that feels a force
  std::optional<UnsteadyFlow> unsteady;  ///< where flow and forces are means over time
  std::vector<GoalValue> goals;          ///< what it was solved for, with an estimate of the error
};

/// The same by any solver.
struct FlowFigures : FlowTables {
  std::optional<double> cl, cd, residual;  ///< where the solver knows them
};

}  // namespace quadloop
