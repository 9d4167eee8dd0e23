#pragma once

#include "flow/euler/solve_euler.hpp"
#include "flow/flow_solver.hpp"

namespace quadloop::flow {

/// Returns the solution with RunConstants.
Field flow_with_constants(const EulerResult& result, const EulerOptions& options);

/// Returns one line for the log; with the time if the run is `in_time`.
std::string line_of(const EulerProgress& progress, bool in_time);

/// Returns the reference state of the coefficients.
FreeStream free_stream_of(const EulerOptions& options);

/// Returns the built-in solver as a FlowSolver. It adds a note for every step that solve_euler() reports, and
/// a warning if it does not converge.
FlowSolver euler_solver(EulerOptions options, AtEnd at_end = {});

}  // namespace quadloop::flow
