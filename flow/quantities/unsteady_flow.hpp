#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flow/quantities/history.hpp"

namespace quadloop {

/// What a number did over some time.
struct Swing {
  double mean = 0, smallest = 0, largest = 0;
};

/// A flow that moves, as its means and what its forces did meanwhile. Times are as HistoryRow::time.
struct UnsteadyFlow {
  double from = 0, to = 0;  ///< what the means are over
  Swing cl, cd;
  /// Of the lift, or of the drag where the lift hardly swings; none where no period is to be seen.
  std::optional<double> period, strouhal;  ///< that and reference length over period and free stream's speed
  int steps = 0;                           ///< in time, from its start
  double longest_step = 0;
  bool implicit = false;
  int unsolved = 0;         ///< implicit steps that did not meet their tolerance
  bool carried_on = false;  ///< after steady steps, or after a flow that was itself carried on
  /// Before, as a steady flow: steps, and to what the residual fell.
  int steady_steps = 0;
  double steady_residual = 0;
};

/// Means, smallest and largest values and period of the rows from this time on, which come in the order of
/// time. A period is seen where a force goes up through its mean three times or more, with at least three
/// tenths of its swing to either side in between, at intervals that differ by no more than three tenths.
UnsteadyFlow unsteady_flow(const std::vector<HistoryRow>& history, double from);

/// For people, in one line without a full stop.
std::string line_of(const UnsteadyFlow& flow);

}  // namespace quadloop
