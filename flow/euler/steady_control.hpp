#pragma once

#include <string>
#include <vector>

#include "flow/euler/residual_watch.hpp"

namespace quadloop::flow::euler {

/// Control of a steady march, based on its residuals alone. Phases and transitions:
///
///     trial  -> plain    the given flow proved good, or start_over() left it for the free stream
///     plain  -> newton   the flow is near its end, or plain steps bring it no farther
///     newton -> pause    a Newton step failed
///     pause  -> newton   after some plain steps, or at once where the limiter is frozen again
class SteadyControl {
 public:
  enum class Phase {
    trial,   ///< plain steps from a given flow that may not converge
    plain,   ///< implicit Euler steps with local time steps
    newton,  ///< Newton steps, once the flow is developed
    pause    ///< plain steps after a failed Newton step
  };
  enum class Limiter { none, live, frozen };

  /// Input of a decision.
  struct Flow {
    int iteration = 0;
    double residual = 0;
    Limiter limiter = Limiter::none;
    bool ends = false;  ///< the tolerance is met, or the maximum number of steps reached
  };
  enum class Next { plain_step, newton_step, return_to_best, start_over, finish, fail };
  struct Decision {
    Next next = Next::plain_step;
    bool is_best = false;         ///< best flow so far: store it
    bool freeze_limiter = false;  ///< after storing it, before the step
    bool mirror = false;          ///< make the flow mirror-symmetric
    std::vector<std::string> messages = {};
  };

  /// `is_given`: the march does not start from the free stream. `may_leave`: it may end before convergence,
  /// to continue in time.
  SteadyControl(bool is_given, bool may_leave)
      : may_leave_{may_leave}, phase_{is_given ? Phase::trial : Phase::plain} {}

  Decision decide(const Flow& flow);

  /// Updates the control after a Newton step: the fraction of the change that lowered the residual, and the
  /// remaining residual of the linear system. Returns whether the limiter should be frozen, as live limiter
  /// factors make such steps fail.
  bool learn(const Flow& flow, double share, double left_over);

  /// CFL number of a plain step, if the first one has `first`; of a Newton step, if a plain one would have
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

}  // namespace quadloop::flow::euler
