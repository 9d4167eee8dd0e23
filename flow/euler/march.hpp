#pragma once

#include <optional>
#include <vector>

#include "flow/euler/in_time/time_average.hpp"
#include "flow/euler/scheme/flow_run.hpp"
#include "flow/euler/solve_euler.hpp"

namespace quadloop::euler {

/// Root mean square of the owned nodes' net mass fluxes; not a number where any is not finite. *Collective.*
double mass_residual(const FlowRun& run, const std::vector<Flux>& fluxes);

/// Gives the far field the vortex of the lift that the states have, where the options ask for it.
/// *Collective.*
void surround(FlowRun& run, FarField& far_field);

/// How steps are counted and kept in the history.
struct Telling {
  bool in_time = false;  ///< progress is that of the time
  int every = 1;         ///< of so many steps one is kept
};

/// Keeps the history, and hands the options' callback what it is due. *Collective.*
void report(const FlowRun& run, EulerResult& result, double cfl, bool at_end, const Telling& telling = {});

/// "at (x, y), where density is ..." of the node, over all ranks, where the flow is least physical: the first
/// that has no gas (is_gas), else the first of the largest flux. *Collective.*
std::string worst_place(const FlowRun& run, const std::vector<Flux>& fluxes);

/// Implicit steps with local time steps until the tolerance is met or the iterations are used up.
/// *Collective.*
EulerResult march_to_steady(FlowRun& run);

/// How far a flow is to go in time.
struct TimePlan {
  double end = 0;
  std::optional<double> average_from, step;  ///< none: no means; explicit steps
  int most_steps = 0;
  double reference = 0;  ///< mass residual that others are relative to; 0: the first
  double tolerance = 0;  ///< a relative residual at which the flow is steady after all
};

/// Steps of one size to the end time. Continues `result`, whose time is that of the states; the flow between
/// `plan.average_from` and the end joins `average`. *Collective.*
void march_in_time(FlowRun& run, const TimePlan& plan, EulerResult& result, TimeAverage& average);

/// Refuses what would take more steps in time than anybody waits for: throws InputError with their number and
/// a step that will do. *Collective.*
void require_few_steps(FlowRun& run);

/// A flow that has no steady state, or a start that was carried on before, goes on in time as the options
/// ask, unless it becomes steady. Where it fails in time, states and result stay as they are, but for
/// EulerResult::failed_in_time. *Collective.*
void carry_on(FlowRun& run, EulerResult& result, TimeAverage& average);

/// The free stream in every node, at rest where it sticks to walls.
std::vector<State> undisturbed(const FlowRun& run);

/// The mass residual of the undisturbed free stream. *Collective.*
double free_stream_residual(FlowRun& run);

}  // namespace quadloop::euler
