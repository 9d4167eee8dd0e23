#pragma once

namespace quadloop::flow::euler {

/// Parameters of a steady march, with reasons. "By trial" means on the flows of docs/notes/flows.md.
/// Residuals are relative, as EulerResult::residual.
struct SteadyParameters {
  /// Below this residual a flow is developed: later changes are not transients of the start. By trial.
  double developed = 0.05;

  /// The CFL number grows as the residual falls: switched evolution relaxation (Mulder and van Leer 1985),
  /// here with the power 0.75 instead of 1, by trial.
  struct Cfl {
    double growth = 0.75;
    /// Larger values fail, as the first-order matrix is too far from the scheme; by trial.
    double largest = 1000;
    int sweeps = 40;  ///< Gauss-Seidel sweeps: fewer leave waves in a far field of many cells; by trial
    /// After a setback the limit falls to `milder` or `harder` of itself. The march goes on with `restart` of
    /// the limit and grows by `recovery` a step. By trial.
    double milder = 0.5, harder = 0.3, restart = 0.2, recovery = 1.05;
  } cfl;

  /// The limiter's factors are frozen if the residual of a developed flow falls slowly, as live factors stall
  /// convergence (Venkatakrishnan 1995). Each rule: below this residual, the best residual was not reduced to
  /// `share` in `steps` steps. By trial; `near` is for solutions transferred from another mesh.
  struct Slow {
    int steps;
    double share;
  };
  struct Freezing {
    double near = 0.02, settled = 3e-3;
    Slow when_developed{30, 0.5}, when_near{10, 0.7}, when_settled{10, 0.4};
  } freezing;

  /// If a node's changes oscillate, its share of the CFL number is reduced (StepFractions): after `turns`
  /// reversals in a row, or after `more_turns` if it is already `small`. A reversal takes back at least this
  /// fraction of the previous change. By trial.
  struct Shares {
    int turns = 4, more_turns = 40;
    float turned_back = 0.8F;
    double fall = 0.5, rise = 1.02, small = 0.03, least = 1e-3;
  } shares;

  /// Inexact Newton steps (Knoll and Keyes 2004) begin below `begin`, with frozen factors, or when plain
  /// steps stall. Their CFL number grows as in pseudo-transient continuation (Kelley and Keyes 1998). By
  /// trial.
  struct Newton {
    double begin = 5e-3;
    Slow stall{100, 0.5};
    double least_share = 0.5;                    ///< fraction of the change; with less the step has failed
    double least_cfl = 10, largest_cfl = 1e9;    ///< the first is close to that of the plain steps
    double solved = 0.15, unsolved = 0.4;        ///< remaining relative residual of the linear system
    double rise = 3, fall = 0.5, failure = 0.3;  ///< factors of the CFL number
    int first_pause = 5, longest_pause = 40;     ///< plain steps after a failure; doubled each time
    /// Linear system: GMRES to this relative tolerance, with sweeps of the first-order system as
    /// preconditioner. Slow flow around a blunt body needs 100 directions: with 40 its circulation converges
    /// slowly.
    double tolerance = 0.1;
    int directions = 100, sweeps = 30;
    int halvings = 5;  ///< attempts to apply the change, each half of the previous one
  } newton;

  /// A flow that blew up, rose or stagnated returns to the best one. By trial.
  struct Setback {
    double blown_up = 1000;  ///< no sound start reaches it
    double exploding = 20;   ///< hardly any sound start reaches it
    double rise = 10;        ///< relative to the best, for rise_steps steps
    int rise_steps = 20;
    int equal_steps = 3;  ///< bitwise equal: changes are not finite, or rejected at all nodes
    int most_retries = 8, most_returns = 8;
    double clearly_better = 2;  ///< the best flow is kept if the last residual is larger by this factor
  } setback;

  /// A residual that oscillates without falling: the path of its logarithm over the window, minus its fall,
  /// and the fall that counts as progress. A transient changes little from step to step. By trial.
  struct Swing {
    int steps = 40;
    double path = 3, progress = 0.5;
  } swing;

  /// A given flow is replaced by the free stream if its best residual is not below `share` of its first after
  /// so many steps or setbacks. By trial.
  struct Trial {
    double share = 0.5;
    int steps = 100, setbacks = 2;
  } trial;

  Slow hopeless{500, 0.5};  ///< such a flow is continued in time if the options request it; by trial
  int least_steps = 60;     ///< before a residual that does not halve in half of all steps counts as stalled
};

inline constexpr SteadyParameters steady_parameters;

}  // namespace quadloop::flow::euler
