#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/plot/canvas/plot_canvas.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::io {

struct ChartLine {
  std::string name;  ///< lines of the same name have the same colour
  std::vector<Point> points;
};

struct ChartAxis {
  std::string title;
  bool logarithmic = false;                         ///< values that are not positive are omitted
  bool reversed = false;                            ///< large values at the bottom
  std::optional<std::array<double, 2>> range = {};  ///< empty: all values, with a margin
};

/// A plot of lines.
struct ChartPanel {
  ChartAxis y;
  std::vector<ChartLine> lines;
};

/// Panels one below the other, with a common x axis.
struct Chart {
  ChartAxis x;
  std::vector<ChartPanel> panels;
  std::vector<double> flags = {};  ///< x positions of thin vertical lines
};

/// Returns the chart as a file's bytes; sizes as in PlotOptions. Throws InputError if a panel is empty.
std::string draw_chart(const Chart& chart, double size, std::optional<Point> centimetres, PlotFormat format);

}  // namespace quadloop::io
