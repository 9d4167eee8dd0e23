#pragma once

#include <string>
#include <vector>

namespace quadloop::flow {

/// Suffix of the history file; it follows the prefix of the solution's file.
inline constexpr const char* history_suffix = ".history.csv";

/// State of a solver after a number of steps.
struct HistoryRow {
  int step = 0;
  double residual = 0, cl = 0, cd = 0;
  double time = 0;
};

/// Returns the history as the text of a table: columns step, residual, cl, cd, and time if any row has one.
std::string history_table(const std::vector<HistoryRow>& history);

}  // namespace quadloop::flow
