#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/plot/canvas/chart.hpp"

namespace quadloop::io {

/// A text table whose first line names its columns, as written by `quadloop solve`.
struct PlotTable {
  std::string path;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each as long as `columns`

  bool has(const std::string& column) const;
  /// Throws InputError, with the file, if there is no such column, or it contains a word that is not a
  /// number.
  std::vector<double> numbers(const std::string& column) const;
  std::vector<std::string> words(const std::string& column) const;
};

/// Fields are separated by commas; a field may be in double quotes. Throws InputError, with the line, for
/// rows whose length differs from the first.
PlotTable read_plot_table(const std::string& path);

/// Returns a chart of a column of a wall table, Cp or another, over x: a line for each chain and loop of a
/// boundary. The Cp axis is reversed. `window` is the range of the axes.
Chart wall_chart(const PlotTable& walls, const std::string& column, const std::optional<Box>& window);

/// Results of one cycle of an adaptive run.
struct CycleStatistics {
  double cycle = 0;
  std::optional<double> residual, cl, cd;
};

/// Returns residual, CL and CD over the cycles, if any cycle has them. Throws InputError if none has any.
Chart cycles_chart(const std::vector<CycleStatistics>& cycles);

/// Returns residual, CL and CD over the steps of consecutive runs, with a mark at the end of each.
Chart history_chart(const std::vector<PlotTable>& histories);

}  // namespace quadloop::io
