#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "flow/euler/model/euler_options.hpp"
#include "flow/postprocess/flow_statistics.hpp"
#include "flow/postprocess/history.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::flow {

/// Result of solve_euler().
struct EulerResult : FlowTables {
  /// euler_names at each owned node, without constants; in viscous flow also wall_shear_name. Time averages
  /// if `unsteady` is set; then the final flow comes last, as at_end_names.
  Field flow;
  int iterations = 0;  ///< number of steps
  /// Root mean square of the nodes' net mass fluxes, relative to the larger of the start's and the uniform
  /// free stream's.
  double residual = 0;
  double cl_friction = 0, cd_friction = 0;  ///< friction part of the coefficients below
  double cl = 0, cd = 0;                    ///< over all boundaries that feels_force() selects, in wind axes
  std::vector<HistoryRow> history;          ///< of every step and the end; of every tenth explicit step
  /// The step of this flow: the last, or that of the best residual if it rose again.
  int kept_iteration = 0;
  /// The step at which the given flow was replaced by the free stream because it did not converge; 0: not
  /// replaced.
  int left_start = 0;
  double last_residual = 0;  ///< after the last step
  bool stalled = false;      ///< whether the residual did not halve in the second half of the steps
  bool converged = false;    ///< steady: tolerance reached; unsteady: end time reached
  int unsolved = 0;          ///< number of implicit time steps that did not meet their tolerance
  double time = 0;           ///< of an unsteady run, or of the unsteady continuation
  /// Message of a failed steady run whose best flow is kept. Empty: it did not fail.
  std::string failed_as_steady;
  /// Message if the flow could not be continued in time; the steady flow is kept. Empty: not requested, or
  /// successful.
  std::string failed_in_time;
};

/// Limit on the number of time steps; larger runs are rejected.
inline constexpr double most_steps_in_time = 1e7;

namespace euler {
struct FlowRun;
}

/// Called on every rank at the end of the run, before the result is reported, with the resulting flow, and
/// may add to the result. *Collective.*
using AtEnd = std::function<void(const Mesh& mesh, euler::FlowRun& run, EulerResult& result)>;

/// Solves the two-dimensional Euler equations, or with a viscosity the laminar Navier-Stokes equations, on a
/// mesh of triangles and quadrilaterals. The initial state is `start`, with a row for each owned node;
/// without variables it follows from the options. The result is bitwise independent of the number of ranks.
/// Throws InputError for an unusable mesh or options, for more than most_steps_in_time steps of a given size,
/// or for a start in which variable() does not find euler_names; SolverError, with the location, if the flow
/// becomes unphysical. *Collective.*
EulerResult solve_euler(const Communicator& comm, const Mesh& mesh, const EulerOptions& options,
                        const Field& start = {}, const AtEnd& at_end = {});

}  // namespace quadloop::flow
