#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/plot/canvas/plot_canvas.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

struct ChartLine {
  std::string name;  ///< lines of one name share their colour
  std::vector<Point> points;
};

struct ChartAxis {
  std::string title;
  bool logarithmic = false;                         ///< values that are not above 0 are left out
  bool reversed = false;                            ///< large values at the bottom
  std::optional<std::array<double, 2>> range = {};  ///< absent: all values, with some room
};

/// Lines over one axis.
struct ChartPanel {
  ChartAxis y;
  std::vector<ChartLine> lines;
};

/// Panels one below the other, over one x axis.
struct Chart {
  ChartAxis x;
  std::vector<ChartPanel> panels;
  std::vector<double> marks = {};  ///< places of x with a thin line from top to bottom
};

/// The chart as a file's bytes; sizes as in PlotOptions. Throws InputError where a panel has nothing to show.
std::string draw_chart(const Chart& chart, double size, std::optional<Point> centimetres, PlotFormat format);

}  // namespace quadloop
