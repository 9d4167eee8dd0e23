#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/plot/canvas/colour_map.hpp"
#include "io/plot/canvas/plot_canvas.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::io {

struct LegendEntry {
  Colour colour;
  std::string name;
  bool is_line = false;  ///< a boundary rather than cells
};

/// A colour bar beside the picture.
struct ColourBar {
  std::string title;
  double low = 0, high = 1;
  ColourMap colour = nullptr;
};

/// Returns the part of the line from a to b inside the box.
std::optional<std::array<Point, 2>> part_within(const Box& box, Point a, Point b);

/// The position of a window of the plane on a sheet with this number of pixels along its longer side,
/// including legend and axes; or on one of this width and height, which it need not fill.
class PlotView {
 public:
  PlotView(const Box& window, double longer_side, const std::vector<LegendEntry>& legend, bool has_bar,
           std::optional<Point> sheet = {});

  /// Returns the window enlarged in one direction such that, on a sheet of this width and height, it fills
  /// the space left by a legend of one row.
  static Box filling(const Box& window, Point sheet, bool has_bar);

  const Box& window() const { return window_; }
  const Box& frame() const { return frame_; }  ///< in pixels
  double scale() const { return scale_; }      ///< pixels per unit of length
  double width() const { return width_; }
  double height() const { return height_; }
  Point pixel(Point p) const {
    return {frame_.low.x + scale_ * (p.x - window_.low.x), frame_.high.y - scale_ * (p.y - window_.low.y)};
  }

  /// Return the visible part of a cell or edge, with a margin, so that coordinates are not too large to draw.
  std::vector<Point> visible_part(std::vector<Point> corners) const;
  std::optional<std::array<Point, 2>> visible_part(Point a, Point b) const;

  void draw_axes(Canvas& canvas, const std::string& x_title, const std::string& y_title) const;
  void draw_legend(Canvas& canvas, const std::vector<LegendEntry>& legend) const;
  void draw_bar(Canvas& canvas, const ColourBar& bar) const;

 private:
  std::vector<Point> legend_places(const std::vector<LegendEntry>& legend, double& bottom) const;

  Box window_, frame_;
  double scale_ = 1, width_ = 0, height_ = 0;
};

}  // namespace quadloop::io
