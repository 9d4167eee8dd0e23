#pragma once

#include <optional>
#include <string>

namespace quadloop::flow {

/// Final values in SU2's history, if it has the columns.
struct Su2End {
  std::optional<double> cl, cd;        ///< columns CL and CD
  std::optional<double> residual;      ///< of the density (or else of the pressure), relative to the first
  std::optional<double> log_residual;  ///< its base-10 logarithm, as in the history
  std::optional<bool> converged;       ///< converged_by_log()
};

/// Parses the text of history.csv: a row of names, often in double quotes, then a row for each iteration;
/// residuals are base-10 logarithms. Unreadable entries are omitted.
Su2End end_of_history(const std::string& text);

/// Whether SU2 met its convergence criteria, by the sentence at the end of what it prints
/// (CSinglezoneDriver::Monitor, CMultizoneDriver::Monitor); empty if the text has neither sentence, as in
/// time-accurate runs.
std::optional<bool> converged_by_log(const std::string& text);

/// Whether SU2 stopped because the flow diverged (COutput::ConvergenceMonitoring), by what it prints.
bool diverged_by_log(const std::string& text);

}  // namespace quadloop::flow
