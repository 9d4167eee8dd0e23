#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "flow/euler/model/euler_options.hpp"
#include "flow/quantities/flow_figures.hpp"
#include "flow/quantities/history.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// What solve_euler found.
struct EulerResult : FlowTables {
  Field flow;           ///< euler_names at each owned node, without constants; a viscous one's
                        ///< wall_shear_name too. Means over time where `unsteady` says so; then the
                        ///< flow at the end comes last, as at_end_names
  int iterations = 0;   ///< steps done
  double residual = 0;  ///< root mean square of the nodes' net mass fluxes, relative to the larger of the
                        ///< start's and the uniform free stream's
  double cl_friction = 0, cd_friction = 0;  ///< the part of friction in what follows
  double cl = 0, cd = 0;                    ///< over all boundaries that feels_force() counts, in wind axes
  std::vector<HistoryRow> history;          ///< of every step and the end; of explicit ones every tenth
  /// The step whose flow this is: the last, or that of the best residual where it rose again.
  int kept_iteration = 0;
  /// The step at which the flow that was given was left for the free stream, since it led nowhere; 0: not.
  int left_start = 0;
  double last_residual = 0;  ///< after the last step
  bool stalled = false;      ///< the residual did not halve in the second half of the steps
  bool converged = false;    ///< steady: the tolerance is met; in time: the end is reached
  int unsolved = 0;          ///< implicit steps in time that did not meet their tolerance
  double time = 0;           ///< of an accurate run, or of the part that was carried on
  /// What ended a steady run whose best flow is kept, for people. Empty: it did not fail.
  std::string failed_as_steady;
  /// Why the flow could not be carried on in time, for people: the steady flow is kept. Empty: it was not
  /// asked, or could.
  std::string failed_in_time;
};

/// In time: what would take more is taken for a mistake.
inline constexpr double most_steps_in_time = 1e7;

namespace euler {
struct FlowRun;
}

/// Called on every rank with the run as it ends, before it is told: the flow that is kept, and what is found
/// of it. May add to that. *Collective.*
using AtEnd = std::function<void(const Mesh& mesh, euler::FlowRun& run, EulerResult& result)>;

/// Solves the two-dimensional Euler equations, or with a viscosity those of laminar flow, on a mesh of
/// triangles and quadrilaterals. The flow starts from `start`, which has a row for each owned node; without
/// variables, as the options say. The result has the same bits on any number of ranks. Throws InputError for
/// a mesh or options that it cannot use, more than most_steps_in_time of a given size, or a start in which
/// variable() does not find euler_names, SolverError, with the place, where the flow cannot be kept physical.
/// *Collective.*
EulerResult solve_euler(const Communicator& comm, const Mesh& mesh, const EulerOptions& options,
                        const Field& start = {}, const AtEnd& at_end = {});

}  // namespace quadloop
