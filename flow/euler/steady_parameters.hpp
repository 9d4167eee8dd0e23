#pragma once

namespace quadloop::euler {

/// The values that steer a steady march, each with its reason. "By trial" means on the flows of
/// docs/notes/flows.md. Residuals are relative, as EulerResult::residual.
struct SteadyParameters {
  /// Below this residual a flow has its shape; what comes later is no transient of the start. By trial.
  double developed = 0.05;

  /// The CFL number grows as the residual falls: switched evolution relaxation (Mulder and van Leer 1985),
  /// here with the power 0.75 instead of 1, by trial.
  struct Cfl {
    double growth = 0.75;
    double largest = 1000;  ///< the first-order matrix is too far from the scheme for more; by trial
    int sweeps = 40;        ///< of Gauss-Seidel: fewer leave waves in a far field of many cells; by trial
    /// After a setback the limit falls to `milder` or `harder` of itself. The march goes on with `restart` of
    /// the limit and grows by `recovery` a step. By trial.
    double milder = 0.5, harder = 0.3, restart = 0.2, recovery = 1.05;
  } cfl;

  /// The limiter's factors are frozen where the residual of a developed flow falls slowly: live factors stop
  /// convergence (Venkatakrishnan 1995). Each rule: below this residual, the best of so many steps ago was
  /// not reduced to that share. By trial; `near` is for flows that are carried over from another mesh.
  struct Slow {
    int steps;
    double share;
  };
  struct Freezing {
    double near = 0.02, settled = 3e-3;
    Slow when_developed{30, 0.5}, when_near{10, 0.7}, when_settled{10, 0.4};
  } freezing;

  /// Where a node's changes oscillate, its share of the CFL number falls (StepShares): after `turns` in a
  /// row, after `more_turns` where it is `small` already. A change turns where it takes back that much of the
  /// one before. By trial.
  struct Shares {
    int turns = 4, more_turns = 40;
    float turned_back = 0.8F;
    double fall = 0.5, rise = 1.02, small = 0.03, least = 1e-3;
  } shares;

  /// Inexact Newton steps (Knoll and Keyes 2004) begin below `begin`, with frozen factors, or where plain
  /// steps stall. Their CFL number grows as in pseudo-transient continuation (Kelley and Keyes 1998). By
  /// trial.
  struct Newton {
    double begin = 5e-3;
    Slow stall{100, 0.5};
    double least_share = 0.5;                    ///< of the change; with less the step failed
    double least_cfl = 10, largest_cfl = 1e9;    ///< the first is near that of the plain steps
    double solved = 0.15, unsolved = 0.4;        ///< of the linear system's residual, left over
    double rise = 3, fall = 0.5, failure = 0.3;  ///< factors of the CFL number
    int first_pause = 5, longest_pause = 40;     ///< plain steps after a failure; doubled each time
    /// Of the linear system: GMRES to that share, with sweeps of the first-order system as preconditioner.
    /// Slow flow round a blunt body needs 100 directions: with 40 its circulation converges slowly.
    double tolerance = 0.1;
    int directions = 100, sweeps = 30;
    int halvings = 5;  ///< attempts to take the change, each half of the one before
  } newton;

  /// A flow that blew up, rose or stands still returns to the best one. By trial.
  struct Setback {
    double blown_up = 1000;  ///< no sound start reaches it
    double exploding = 20;   ///< hardly any sound start reaches it
    double rise = 10;        ///< times the best, for so many steps
    int rise_steps = 20;
    int equal_steps = 3;  ///< equal bits: changes are not finite, or no node can bear any
    int most_retries = 8, most_returns = 8;
    double clearly_better = 2;  ///< the best flow is kept rather than a last one with that many times more
  } setback;

  /// A residual that oscillates and does not fall: the path of its logarithm over the window, beyond its
  /// fall, and the fall that counts as progress. A transient changes little from step to step. By trial.
  struct Swing {
    int steps = 40;
    double path = 3, progress = 0.5;
  } swing;

  /// A flow that was given is left for the free stream if its best residual is not below `share` of its first
  /// after so many steps or setbacks. By trial.
  struct Trial {
    double share = 0.5;
    int steps = 100, setbacks = 2;
  } trial;

  Slow hopeless{500, 0.5};  ///< such a flow is continued in time where the options ask for it; by trial
  int least_steps = 60;     ///< before a residual that does not halve in half of all steps is called stalled
};

inline constexpr SteadyParameters steady_parameters;

}  // namespace quadloop::euler
