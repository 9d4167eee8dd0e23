#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "flow/euler/implicit/implicit_system.hpp"
#include "flow/euler/implicit/state_update.hpp"
#include "flow/euler/march.hpp"
#include "flow/euler/mirrored_states.hpp"
#include "flow/euler/newton_step.hpp"
#include "flow/euler/steady_control.hpp"
#include "flow/euler/step_fractions.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::flow::euler {

namespace {

class SteadyMarch {
 public:
  explicit SteadyMarch(FlowRun& run)
      : run_{run},
        control_(run.is_transferred, run.options.unsteady == EulerOptions::Unsteady::continue_in_time),
        system_(run.comm, run.mesh, run.model),
        change_(run.mesh.nodes()),
        shares_(run.mesh.owned_nodes()),
        far_field_(run.comm, run.mesh, run.model),
        best_states_{run.states} {
    reference_ = of_free_stream_ = free_stream_residual(run);
    zero_ = rounding(run);
  }

  EulerResult march() {
    while (true) {
      surround(run_, far_field_);
      const IdVector<NodeId, Flux>& fluxes = run_.residual.evaluate(run_.states);
      measure(fluxes);
      if (result_.converged && becomes_image()) continue;
      const SteadyControl::Decision decision = control_.decide(flow_now());
      tell(decision);
      if (decision.is_best) best_states_ = run_.states;
      const double cfl = control_.cfl(run_.options.cfl, result_.residual);
      switch (decision.next) {
        case Next::fail: return end_at_best(fluxes);
        case Next::finish: return finish(cfl);
        case Next::start_over: leave_start(); continue;
        case Next::return_to_best: go_back(); continue;
        case Next::plain_step:
        case Next::newton_step: break;
      }
      if (decision.freeze_limiter) keep_limiter();
      if (decision.mirror) mirror();
      report(run_, result_, cfl, false);
      if (decision.next == Next::newton_step)
        newton_step(fluxes, cfl);
      else
        step(fluxes, cfl);
      ++result_.iterations;
      is_stepped_ = true;
    }
  }

 private:
  using Next = SteadyControl::Next;

  /// Residual of an undisturbed flow from rounding: fluxes are of the size of the dual cells' sides.
  static double rounding(const FlowRun& run) {
    const auto count = static_cast<double>(run.comm.sum(run.mesh.owned_nodes()));
    return 1e-14 * std::sqrt(reproducible_sum(run.comm, run.mesh.areas()) / count);
  }

  void measure(const IdVector<NodeId, Flux>& fluxes) {
    const double norm = mass_residual(run_, fluxes);
    if (result_.iterations == 0 && norm > reference_) reference_ = norm;
    const bool is_zero = norm <= zero_;
    result_.residual = is_zero ? 0 : norm / reference_;
    result_.converged = is_zero || result_.residual <= run_.options.tolerance;
  }

  SteadyControl::Flow flow_now() const {
    using Limiter = SteadyControl::Limiter;
    const Limiter limiter = run_.residual.limiter_is_live()     ? Limiter::live
                            : run_.residual.limiter_is_frozen() ? Limiter::frozen
                                                                : Limiter::none;
    const bool ends = result_.converged || result_.iterations >= run_.options.iterations;
    return {result_.iterations, result_.residual, limiter, ends};
  }

  void tell(const SteadyControl::Decision& decision) const {
    if (!run_.comm.is_root()) return;
    for (const std::string& message : decision.messages) {
      const std::string line = fmt::format("step {}: {}", result_.iterations, message);
      decision.next == Next::start_over ? log::information(line) : log::detail(line);
    }
  }

  /// Restarts from the free stream, as without a start.
  void leave_start() {
    result_.left_start = std::max(1, result_.iterations);
    run_.states = best_states_ = undisturbed(run_);
    run_.residual.release_limiter();
    shares_.restart();
    reference_ = of_free_stream_;
  }

  /// After too many blow-ups: keeps the best flow if it is developed, else fails.
  EulerResult end_at_best(const IdVector<NodeId, Flux>& fluxes) {
    const std::string failure = fmt::format(
        "the flow solver failed after {} steps {}; check the boundary conditions and the cells there, or try "
        "a smaller cfl",
        result_.iterations, worst_place(run_, fluxes));
    if (control_.best().residual > steady_parameters.developed) throw SolverError(failure);
    result_.failed_as_steady = failure;
    result_.residual = std::numeric_limits<double>::infinity();
    return finish(0);
  }

  /// Returns to the best flow so far, to continue with smaller steps.
  void go_back() {
    run_.states = best_states_;
    if (!control_.best().limiter_frozen) run_.residual.release_limiter();
    shares_.forget();
  }

  /// Steps break the mirror symmetry of the flow within the tolerance. Restores it, once per step; returns
  /// whether it did.
  bool becomes_image() {
    if (!is_stepped_) return false;
    is_stepped_ = false;
    mirror();
    return mirrored_.has_value();
  }

  /// Makes the flow symmetric if requested: the order of the sweeps is not.
  void mirror() {
    if (run_.options.mirror && !mirrored_)
      mirrored_ = MirroredStates::find(run_.comm, run_.mesh, run_.model, *run_.options.mirror);
    if (!mirrored_) return;
    mirrored_->average(run_.states);
    run_.residual.evaluate(run_.states);
  }

  /// Makes the flow symmetric first, as asymmetric limiter factors would keep it asymmetric however far the
  /// residual falls.
  void keep_limiter() {
    mirror();
    run_.residual.freeze_limiter();
    shares_.restart();
  }

  /// Returns the last flow, or the best one if that is clearly better.
  EulerResult finish(double cfl) {
    result_.kept_iteration = result_.iterations;
    result_.last_residual = result_.residual;
    result_.stalled = control_.is_slow();
    const BestFlow& best = control_.best();
    if (!result_.converged && best.keeps(result_.residual)) {
      run_.states = best_states_;
      result_.residual = best.residual;
      result_.kept_iteration = best.iteration;
    }
    report(run_, result_, cfl, true);
    return result_;
  }

  void step(const IdVector<NodeId, Flux>& fluxes, double cfl) {
    system_.assemble(run_.states, cfl, shares_.shares(), run_.residual.shocks());
    system_.relax(fluxes, steady_parameters.cfl.sweeps, change_);
    shares_.follow(change_);
    for (const NodeId node : run_.mesh.owned_ids())
      run_.states[node] = updated(run_.model.gas, run_.states[node],
                                  {change_[node][0], change_[node][1], change_[node][2], change_[node][3]});
  }

  void newton_step(const IdVector<NodeId, Flux>& fluxes, double cfl) {
    if (!newton_) newton_.emplace(run_, system_);
    const NewtonStep::Taken taken = newton_->take(fluxes, control_.newton_cfl(cfl), shares_.shares());
    if (!control_.learn(flow_now(), taken.share, taken.left_over)) return;
    run_.residual.evaluate(run_.states);
    keep_limiter();
    if (run_.comm.is_root())
      log::detail(fmt::format("step {}: a Newton step failed: the limiter is frozen from here on",
                              result_.iterations));
  }

  FlowRun& run_;
  SteadyControl control_;
  ImplicitSystem system_;
  IdVector<NodeId, Change> change_;
  StepFractions shares_;
  FarField far_field_;
  EulerResult result_;
  std::optional<NewtonStep> newton_;
  std::optional<MirroredStates> mirrored_;
  IdVector<NodeId, State> best_states_;
  double reference_ = 0, zero_ = 0;  ///< mass residuals: reference of the tolerance; rounding
  double of_free_stream_ = 0;
  bool is_stepped_ = false;
};

}  // namespace

EulerResult march_to_steady(FlowRun& run) { return SteadyMarch(run).march(); }

}  // namespace quadloop::flow::euler
