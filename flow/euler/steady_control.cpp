#include "flow/euler/steady_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace quadloop::flow::euler {

SteadyControl::Decision SteadyControl::decide(const Flow& flow) {
  const double residual = flow.residual;
  if (!std::isfinite(residual) || residual > steady_parameters.setback.blown_up) return after_blow_up(flow);
  if (flow.ends || (may_leave_ && stall_.is(steady_parameters.hopeless))) return {Next::finish};
  if (flow.iteration == 0) first_residual_ = residual;
  if (leads_nowhere(flow)) return start_over();

  limit_.recover();
  Decision decision;
  decision.is_best = best_.improves(flow.iteration, residual, flow.limiter == Limiter::frozen);
  if (phase_ == Phase::trial && best_.residual <= proof()) phase_ = Phase::plain;
  if (sets_back(flow, decision)) return decision;
  if (swing_.swings(residual)) {
    limit_.lower(steady_parameters.cfl.milder);
    decision.messages.emplace_back("the residual oscillates: smaller CFL number");
  }
  stall_.add(residual);
  if (flow.limiter == Limiter::live && falls_slowly(residual)) {
    decision.freeze_limiter = true;
    begin_newton_anew();
    decision.messages.emplace_back("the limiter is frozen from here on");
  }
  if (phase_ == Phase::plain && (flow.limiter == Limiter::frozen || is_near_end(residual))) {
    phase_ = Phase::newton;
    decision.mirror = true;
  }
  decision.next = step_at(residual);
  return decision;
}

SteadyControl::Decision SteadyControl::after_blow_up(const Flow& flow) {
  if (leads_nowhere(flow)) return start_over();
  if (++retries_ > steady_parameters.setback.most_retries || flow.iteration == 0) return {Next::fail};
  limit_.lower(steady_parameters.cfl.harder);
  return {Next::return_to_best};
}

/// Residual below which a given flow counts as a good start.
double SteadyControl::proof() const {
  return std::max(steady_parameters.developed, steady_parameters.trial.share * first_residual_);
}

bool SteadyControl::leads_nowhere(const Flow& flow) const {
  return phase_ == Phase::trial && (flow.iteration >= steady_parameters.trial.steps ||
                                    returns_ + retries_ > steady_parameters.trial.setbacks);
}

SteadyControl::Decision SteadyControl::start_over() {
  const BestFlow best = best_;
  *this = SteadyControl(false, may_leave_);
  return {.next = Next::start_over,
          .messages = {fmt::format("no convergence from the given initial flow (residual {:.2e} at step {}): "
                                   "restart from the free stream",
                                   best.residual, best.iteration)}};
}

/// Whether the flow returns to the best one because it deteriorates. After too many returns it does not: a
/// flow without a steady state may then oscillate freely.
bool SteadyControl::sets_back(const Flow& flow, Decision& decision) {
  const auto& setback = steady_parameters.setback;
  const bool stands = standstill_.ends(flow.residual == last_residual_),
             explodes = stands || flow.residual > setback.exploding;
  last_residual_ = flow.residual;
  const bool returns = explodes || rise_.ends(best_.residual < steady_parameters.developed &&
                                              flow.residual > setback.rise * best_.residual);
  if (!returns || ++returns_ > setback.most_returns) return false;
  decision.next = Next::return_to_best;
  decision.messages.push_back(fmt::format(
      "the residual {} {:.2e} at step {} {} {:.2e}: restart from that step with a smaller CFL number",
      stands ? "was" : "rose from", best_.residual, best_.iteration, stands ? "and stalled at" : "to",
      flow.residual));
  limit_.lower(explodes ? steady_parameters.cfl.harder : steady_parameters.cfl.milder);
  return true;
}

bool SteadyControl::falls_slowly(double residual) const {
  const auto& freezing = steady_parameters.freezing;
  return (residual < steady_parameters.developed && stall_.is(freezing.when_developed)) ||
         (residual < freezing.near && stall_.is(freezing.when_near)) ||
         (residual < freezing.settled && stall_.is(freezing.when_settled));
}

bool SteadyControl::is_near_end(double residual) const {
  const auto& newton = steady_parameters.newton;
  return residual < newton.begin || (best_.residual < steady_parameters.developed && stall_.is(newton.stall));
}

SteadyControl::Next SteadyControl::step_at(double residual) {
  if (phase_ == Phase::trial || phase_ == Phase::plain || residual >= steady_parameters.developed)
    return Next::plain_step;
  if (phase_ == Phase::pause && rest_-- > 0) return Next::plain_step;
  phase_ = Phase::newton;
  return Next::newton_step;
}

bool SteadyControl::learn(const Flow& flow, double share, double left_over) {
  const auto& newton = steady_parameters.newton;
  if (share >= newton.least_share) {
    if (left_over > newton.unsolved)
      newton_cfl_ = std::max(newton.least_cfl, newton.fall * newton_cfl_);
    else if (share == 1 && left_over < newton.solved)
      newton_cfl_ = std::min(newton.largest_cfl, newton.rise * newton_cfl_);
    return false;
  }
  newton_cfl_ = std::max(newton.least_cfl, newton.failure * newton_cfl_);
  phase_ = Phase::pause;
  rest_ = pause_;
  pause_ = std::min(newton.longest_pause, 2 * pause_);
  const bool freezes = flow.limiter == Limiter::live && flow.residual < steady_parameters.freezing.settled;
  if (freezes) begin_newton_anew();
  return freezes;
}

/// Frozen factors change the residual, so Newton steps may succeed immediately.
void SteadyControl::begin_newton_anew() {
  if (phase_ == Phase::pause) phase_ = Phase::newton;
  newton_cfl_ = 0;
  rest_ = 0;
  pause_ = steady_parameters.newton.first_pause;
}

double SteadyControl::cfl(double first, double residual) const {
  return limit_.share() * std::min(steady_parameters.cfl.largest,
                                   first * std::max(1.0, std::pow(residual, -steady_parameters.cfl.growth)));
}

double SteadyControl::newton_cfl(double plain) {
  if (newton_cfl_ == 0) newton_cfl_ = plain;
  return newton_cfl_;
}

}  // namespace quadloop::flow::euler
