#pragma once

#include <string>
#include <vector>

namespace quadloop {

/// What follows the prefix of a solution's file in the name of its history.
inline constexpr const char* history_suffix = ".history.csv";

/// How far a solver had come after so many steps.
struct HistoryRow {
  int step = 0;
  double residual = 0, cl = 0, cd = 0;
  double time = 0;
};

/// The history as the text of a table: columns step, residual, cl, cd, and where any row has a time, time.
std::string history_table(const std::vector<HistoryRow>& history);

}  // namespace quadloop
