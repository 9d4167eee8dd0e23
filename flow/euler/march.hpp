#pragma once

#include <optional>

#include "flow/euler/in_time/time_average.hpp"
#include "flow/euler/scheme/flow_run.hpp"
#include "flow/euler/solve_euler.hpp"

namespace quadloop::flow::euler {

/// Returns the root mean square of the owned nodes' net mass fluxes; NaN if any is not finite. *Collective.*
double mass_residual(const FlowRun& run, const IdVector<NodeId, Flux>& fluxes);

/// Sets the far-field vortex to the current lift, if the options request it. *Collective.*
void surround(FlowRun& run, FarField& far_field);

/// How steps are counted and recorded in the history.
struct Telling {
  bool in_time = false;  ///< whether progress is measured in time
  int every = 1;         ///< interval of recorded steps
};

/// Records the history and calls the options' callback when due. *Collective.*
void report(const FlowRun& run, EulerResult& result, double cfl, bool at_end, const Telling& telling = {});

/// Returns "at (x, y), where density is ..." for the least physical node over all ranks: the first unphysical
/// one (is_gas()), else the first with the largest flux. *Collective.*
std::string worst_place(const FlowRun& run, const IdVector<NodeId, Flux>& fluxes);

/// Takes implicit steps with local time steps until the tolerance or the maximum number of iterations is
/// reached. *Collective.*
EulerResult march_to_steady(FlowRun& run);

/// Parameters of an unsteady run.
struct TimePlan {
  double end = 0;
  std::optional<double> average_from, step;  ///< empty: no averages; empty: explicit steps
  int most_steps = 0;
  double reference = 0;  ///< reference mass residual; 0: the first one
  double tolerance = 0;  ///< relative residual at which the flow counts as steady
};

/// Takes steps of equal size to the end time. Continues `result`, whose time is that of the states; the flow
/// from `plan.average_from` to the end is added to `average`. *Collective.*
void march_in_time(FlowRun& run, const TimePlan& plan, EulerResult& result, TimeAverage& average);

/// Throws InputError, with the number of steps and a suitable step size, if the run would take an
/// unreasonable number of time steps. *Collective.*
void require_few_steps(FlowRun& run);

/// Continues a steady computation without steady state, or from a start that was itself continued, in time as
/// the options request, unless it becomes steady. If this fails, states and result are unchanged, except for
/// EulerResult::failed_in_time. *Collective.*
void continue_in_time(FlowRun& run, EulerResult& result, TimeAverage& average);

/// Returns the free stream at every node, at rest at no-slip walls.
IdVector<NodeId, State> undisturbed(const FlowRun& run);

/// Returns the mass residual of the undisturbed free stream. *Collective.*
double free_stream_residual(FlowRun& run);

}  // namespace quadloop::flow::euler
