#pragma once

#include <string>
#include <vector>

#include "flow/euler/residual_watch.hpp"

namespace quadloop::euler {

/// How a steady march goes on, decided by its residuals alone. The phases and their transitions:
///
///     trial  -> plain    the given flow proved good, or start_over() left it for the free stream
///     plain  -> newton   the flow is near its end, or plain steps bring it no farther
///     newton -> pause    a Newton step failed
///     pause  -> newton   after some plain steps, or at once where the limiter is frozen anew
class SteadyControl {
 public:
  enum class Phase {
    trial,   ///< plain steps from a flow that was given and may lead nowhere
    plain,   ///< implicit Euler steps with local time steps
    newton,  ///< Newton steps, where the flow is developed
    pause    ///< plain steps after a Newton step that failed
  };
  enum class Limiter { none, live, frozen };

  /// What there is to decide upon at a flow.
  struct Flow {
    int iteration = 0;
    double residual = 0;
    Limiter limiter = Limiter::none;
    bool ends = false;  ///< the tolerance is met, or the steps are used up
  };
  enum class Next { plain_step, newton_step, return_to_best, start_over, finish, fail };
  struct Decision {
    Next next = Next::plain_step;
    bool is_best = false;         ///< so far: the flow is to be remembered
    bool freeze_limiter = false;  ///< and then, before the step
    bool mirror = false;          ///< a flow that is meant to be its own image is to be made so
    std::vector<std::string> messages = {};
  };

  /// `is_given`: the march does not begin with the free stream. `may_leave`: it may end before it converged,
  /// to go on in time.
  SteadyControl(bool is_given, bool may_leave)
      : may_leave_{may_leave}, phase_{is_given ? Phase::trial : Phase::plain} {}

  Decision decide(const Flow& flow);

  /// Of the Newton step that was decided: which share of the change lowered the residual, and what was left
  /// of the linear system's. Tells whether the limiter is to be frozen, since live factors are what such
  /// steps fail at.
  bool learn(const Flow& flow, double share, double left_over);

  /// Of a plain step, where the first is to be `first`; of a Newton step, where a plain one would have
  /// `plain`.
  double cfl(double first, double residual) const;
  double newton_cfl(double plain);

  Phase phase() const { return phase_; }
  const BestFlow& best() const { return best_; }
  bool is_slow() const { return stall_.is_slow(); }

 private:
  Decision after_blow_up(const Flow& flow);
  Decision start_over();
  double proof() const;
  bool leads_nowhere(const Flow& flow) const;
  bool sets_back(const Flow& flow, Decision& decision);
  bool falls_slowly(double residual) const;
  bool is_near_end(double residual) const;
  void begin_newton_anew();
  Next step_at(double residual);

  bool may_leave_;
  Phase phase_;
  StallWatch stall_;
  SwingWatch swing_;
  Patience rise_{steady_parameters.setback.rise_steps}, standstill_{steady_parameters.setback.equal_steps};
  CflLimit limit_;
  BestFlow best_;
  double first_residual_ = 0, last_residual_ = -1;
  int retries_ = 0, returns_ = 0;
  double newton_cfl_ = 0;  ///< 0: that of a plain step
  int rest_ = 0, pause_ = steady_parameters.newton.first_pause;
};

}  // namespace quadloop::euler
