#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "flow/euler/flow_run.hpp"
#include "flow/euler/implicit/implicit_system.hpp"
#include "flow/euler/implicit/state_update.hpp"
#include "flow/euler/mirrored_states.hpp"
#include "flow/euler/newton_pilot.hpp"
#include "flow/euler/newton_step.hpp"
#include "flow/euler/residual_watch.hpp"
#include "flow/euler/step_shares.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::euler {

namespace {

/// Of a step's linear system: fewer leave waves in a far field of many cells long under way.
constexpr int sweeps = 40;
constexpr double largest_cfl = 1000;  ///< first-order matrices do not bear out more
constexpr double growth = 0.75;       ///< the CFL number grows as the residual falls, to this power
constexpr double near_end = 5e-3;     ///< a residual at which Newton steps begin
constexpr double blown_up = 1000;     ///< a relative residual that no sound start reaches
constexpr double exploding = 20;      ///< one that hardly any sound start reaches
constexpr int start_patience = 100, start_retries = 2;  ///< before a flow that was given is left
constexpr int most_retries = 8;                         ///< after a flow blew up
/// After the residual rose: a flow that has no steady state may swing as it likes then.
constexpr int most_returns = 8;

class SteadyMarch {
 public:
  explicit SteadyMarch(const FlowRun& run)
      : run_{run},
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
      const std::vector<Flux>& fluxes = run_.residual.evaluate(run_.states);
      measure(fluxes);
      if (!std::isfinite(result_.residual) || result_.residual > blown_up) {
        if (start_is_useless()) {
          leave_start();
        } else if (++retries_ > most_retries || result_.iterations == 0) {
          return end_at_best(fluxes);
        } else {
          limit_.lower(0.3);
          go_back();
        }
        continue;
      }
      if (result_.converged && becomes_image()) continue;
      const bool ends =
          result_.converged || result_.iterations >= run_.options.iterations || is_left_to_time();
      if (!ends && watch()) continue;
      const double cfl =
          limit_.share() *
          std::min(largest_cfl, run_.options.cfl * std::max(1.0, std::pow(result_.residual, -growth)));
      if (ends) return finish(cfl);
      report(run_, result_, cfl, false);
      if (pilot_.tries(result_.residual)) {
        newton_step(fluxes, cfl);
      } else {
        step(fluxes, cfl);
      }
      ++result_.iterations;
      is_stepped_ = true;
    }
  }

 private:
  /// What the residual of an undisturbed flow may be: fluxes are of the size of the dual cells' sides.
  static double rounding(const FlowRun& run) {
    const std::vector<double> areas(run.mesh.areas().begin(), run.mesh.areas().end());
    const auto count = static_cast<double>(run.comm.sum(run.mesh.owned_nodes()));
    return 1e-14 * std::sqrt(reproducible_sum(run.comm, areas) / count);
  }

  void measure(const std::vector<Flux>& fluxes) {
    const double norm = mass_residual(run_, fluxes);
    if (result_.iterations == 0 && norm > reference_) reference_ = norm;
    const bool is_zero = norm <= zero_;
    result_.residual = is_zero ? 0 : norm / reference_;
    result_.converged = is_zero || result_.residual <= run_.options.tolerance;
  }

  /// Whether a flow that was given leads nowhere: it has hardly become better for long, or went wrong again
  /// and again.
  bool start_is_useless() const {
    return run_.is_carried && result_.left_start == 0 &&
           best_.residual > std::max(developed, 0.5 * start_residual_) &&
           (result_.iterations >= start_patience || returns_ + retries_ > start_retries);
  }

  /// From the free stream, as without a start.
  void leave_start() {
    result_.left_start = std::max(1, result_.iterations);
    if (run_.comm.is_root())
      log::information(
          fmt::format("step {}: the flow that was given leads nowhere (residual {:.2e} at step {}): on from "
                      "the free stream",
                      result_.iterations, best_.residual, best_.iteration));
    run_.states = best_states_ = undisturbed(run_);
    run_.residual.release_limiter();
    shares_.restart();
    stall_ = {};
    rise_ = {};
    standstill_ = {};
    swing_ = {};
    limit_ = {};
    best_ = {};
    pilot_ = {};
    retries_ = returns_ = 0;
    reference_ = of_free_stream_;
  }

  /// The flow blew up once more than is borne. One that has its shape is worth keeping.
  EulerResult end_at_best(const std::vector<Flux>& fluxes) {
    const std::string failure = fmt::format(
        "the flow solver failed after {} steps {}; look at the boundary conditions and the "
        "cells there, or try a smaller cfl",
        result_.iterations, worst_place(run_, fluxes));
    if (best_.residual > developed) throw SolverError(failure);
    result_.failed_as_steady = failure;
    result_.residual = std::numeric_limits<double>::infinity();
    return finish(0);
  }

  /// To the best flow so far, to leave it in smaller steps.
  void go_back() {
    run_.states = best_states_;
    if (!best_.limiter_frozen) run_.residual.release_limiter();
    shares_.forget();
  }

  /// The flow has had its chance, and is to be carried on in time.
  bool is_left_to_time() const {
    return run_.options.unsteady == EulerOptions::Unsteady::carry_on && stall_.is_over();
  }

  /// Keeps the best flow. Tells whether the flow was set back to it, as it is on the way to a worse one.
  bool watch() {
    if (result_.iterations == 0) start_residual_ = result_.residual;
    if (start_is_useless()) {
      leave_start();
      return true;
    }
    limit_.recover();
    const bool frozen = run_.residual.limiter_is_frozen();
    if (best_.improves(result_.iterations, result_.residual, frozen)) best_states_ = run_.states;
    const bool stands = standstill_.stands(result_.residual),
               explodes = stands || result_.residual > exploding;
    if ((explodes || rise_.rises(result_.residual, best_.residual)) && ++returns_ <= most_returns) {
      tell(fmt::format(
          "the residual {} from {:.2e} at step {} {} {:.2e}: back to that flow, with a smaller cfl",
          stands ? "went" : "rose", best_.residual, best_.iteration, stands ? "to a standstill at" : "to",
          result_.residual));
      limit_.lower(explodes ? 0.3 : 0.5);
      go_back();
      return true;
    }
    if (swing_.swings(result_.residual)) {
      limit_.lower(0.5);
      tell("the residual goes to and fro: a smaller cfl");
    }
    if (stall_.stalls(result_.residual) && run_.residual.limiter_is_live()) {
      keep_limiter();
      tell("the limiter's factors are kept from here on");
    }
    if (stall_.rests() || frozen || result_.residual < near_end) call_newton();
    return false;
  }

  /// Steps leave a flow that is its own image but for what the tolerance bears. Tells whether that was
  /// mended, once after each step.
  bool becomes_image() {
    if (!is_stepped_) return false;
    is_stepped_ = false;
    mirror();
    return mirrored_.has_value();
  }

  void call_newton() {
    if (!pilot_.is_called()) mirror();
    pilot_.call();
  }

  /// Sweeps go in an order that no mirror keeps: a flow that is to be its own image is made so.
  void mirror() {
    if (run_.options.mirror && !mirrored_)
      mirrored_ = MirroredStates::find(run_.comm, run_.mesh, run_.model, *run_.options.mirror);
    if (!mirrored_) return;
    mirrored_->average(run_.states);
    run_.residual.evaluate(run_.states);
  }

  /// Factors of a flow that is not its own image would leave one that is not, however far the residual falls.
  void keep_limiter() {
    mirror();
    run_.residual.freeze_limiter();
    shares_.restart();
    pilot_.restart();
  }

  void tell(const std::string& what) const {
    if (run_.comm.is_root()) log::detail(fmt::format("step {}: {}", result_.iterations, what));
  }

  /// The last flow, or the best where it was clearly better.
  EulerResult finish(double cfl) {
    result_.kept_iteration = result_.iterations;
    result_.last_residual = result_.residual;
    result_.stalled = stall_.is_slow();
    if (!result_.converged && best_.keeps(result_.residual)) {
      run_.states = best_states_;
      result_.residual = best_.residual;
      result_.kept_iteration = best_.iteration;
    }
    report(run_, result_, cfl, true);
    return result_;
  }

  void step(const std::vector<Flux>& fluxes, double cfl) {
    system_.assemble(run_.states, cfl, shares_.shares(), run_.residual.shocks());
    system_.relax(fluxes, sweeps, change_);
    shares_.follow(change_);
    const std::size_t owned = run_.mesh.owned_nodes();
    for (std::size_t node = 0; node < owned; ++node)
      run_.states[node] = updated(run_.model.gas, run_.states[node],
                                  {change_[node][0], change_[node][1], change_[node][2], change_[node][3]});
  }

  void newton_step(const std::vector<Flux>& fluxes, double cfl) {
    if (!newton_) newton_.emplace(run_, system_);
    const NewtonStep::Taken taken = newton_->take(fluxes, pilot_.cfl(cfl), shares_.shares());
    const bool failed = pilot_.learn(taken.share, taken.left_over);
    if (!failed || !StallWatch::is_settled(result_.residual) || !run_.residual.limiter_is_live()) return;
    run_.residual.evaluate(run_.states);
    keep_limiter();  // live factors are what such steps fail at
    tell("a Newton step failed: the limiter's factors are kept from here on");
  }

  FlowRun run_;
  ImplicitSystem system_;
  std::vector<Change> change_;
  StepShares shares_;
  FarField far_field_;
  EulerResult result_;
  std::optional<NewtonStep> newton_;
  NewtonPilot pilot_;
  StallWatch stall_;
  RiseWatch rise_;
  StandstillWatch standstill_;
  SwingWatch swing_;
  CflLimit limit_;
  BestFlow best_;
  std::optional<MirroredStates> mirrored_;
  std::vector<State> best_states_;
  double reference_ = 0, zero_ = 0;  ///< mass residuals: that which the tolerance is relative to; rounding
  double of_free_stream_ = 0, start_residual_ = 0;
  int retries_ = 0, returns_ = 0;
  bool is_stepped_ = false;
};

}  // namespace

EulerResult march_to_steady(const FlowRun& run) { return SteadyMarch(run).march(); }

}  // namespace quadloop::euler
