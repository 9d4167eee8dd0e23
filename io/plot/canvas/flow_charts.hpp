#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/plot/canvas/chart.hpp"

namespace quadloop {

/// A table of text with a first line that names its columns, as `quadloop solve` leaves beside a flow.
struct PlotTable {
  std::string path;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< each as long as `columns`

  bool has(const std::string& column) const;
  /// Throws InputError, with the file, where there is no such column, or in it a word that is no number.
  std::vector<double> numbers(const std::string& column) const;
  std::vector<std::string> words(const std::string& column) const;
};

/// Divided at commas; a word may stand in double quotes. Throws InputError, with the line, for rows of other
/// lengths than the first.
PlotTable read_plot_table(const std::string& path);

/// A column of a table of walls, Cp or another, over x: a line for each chain and loop of a boundary. Cp runs
/// downwards. `window` is what the axes show.
Chart wall_chart(const PlotTable& walls, const std::string& column, const std::optional<Box>& window);

/// What one cycle of an adaptive run came to.
struct CycleFigures {
  double cycle = 0;
  std::optional<double> residual, cl, cd;
};

/// Residual, CL and CD over the cycles, as far as any cycle has them. Throws InputError where none has any.
Chart cycles_chart(const std::vector<CycleFigures>& cycles);

/// Residual, CL and CD over steps, of runs that follow each other, with a mark where one ends.
Chart history_chart(const std::vector<PlotTable>& histories);

}  // namespace quadloop
