#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flow/postprocess/history.hpp"

namespace quadloop::flow {

/// Mean, minimum and maximum of a coefficient over time.
struct Swing {
  double mean = 0, smallest = 0, largest = 0;
};

/// Statistics of an unsteady flow. Times are as HistoryRow::time.
struct UnsteadyFlow {
  double from = 0, to = 0;  ///< averaging interval
  Swing cl, cd;
  /// Period of the lift, or of the drag if the lift hardly oscillates; empty if there is no period.
  std::optional<double> period, strouhal;  ///< strouhal: reference length over period times free-stream speed
  int steps = 0;                           ///< time steps from the start of the unsteady run
  double longest_step = 0;
  bool implicit = false;
  int unsolved = 0;        ///< implicit steps that did not meet their tolerance
  bool continued = false;  ///< whether it continues a steady run, or a flow that was itself continued
  /// Steps and final residual of the preceding steady run.
  int steady_steps = 0;
  double steady_residual = 0;
};

/// Returns averages, minima, maxima and period of the rows from this time on; `history` must be in the order
/// of time. A period is detected if a force rises through its mean at least three times, deviating in between
/// by at least three tenths of its amplitude to both sides, at intervals that differ by at most three tenths.
UnsteadyFlow unsteady_flow(const std::vector<HistoryRow>& history, double from);

/// Returns one line for the log, without a full stop.
std::string line_of(const UnsteadyFlow& flow);

}  // namespace quadloop::flow
