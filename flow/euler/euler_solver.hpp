#pragma once

#include "flow/euler/solve_euler.hpp"
#include "flow/flow_solver.hpp"

namespace quadloop {

/// The flow with RunConstants.
Field flow_with_constants(const EulerResult& result, const EulerOptions& options);

/// For people; with the time where the run is `in_time`.
std::string line_of(const EulerProgress& progress, bool in_time);

/// What its coefficients are relative to.
FreeStream free_stream_of(const EulerOptions& options);

/// The built-in solver as any other: notes every step that solve_euler() tells of, warns where a flow did not
/// converge.
FlowSolver euler_solver(EulerOptions options, AtEnd at_end = {});

}  // namespace quadloop
