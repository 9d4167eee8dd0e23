#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "io/plot/plot_canvas.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

struct LegendEntry {
  Colour colour;
  std::string name;
  bool is_line = false;  ///< a boundary rather than cells
};

/// A bar beside the picture that tells what number a colour stands for.
struct ColourBar {
  std::string title;
  double low = 0, high = 1;
  Colour (*colour)(double) = nullptr;  ///< of 0 to 1
};

/// 0 dark blue to 1 yellow, evenly perceived.
Colour perceptual_colour(double t);
/// 0 red, 0.5 yellow, 1 green.
Colour quality_colour(double t);

/// Where a window of the plane lies on a sheet whose longer side has so many pixels, legend and axes
/// included.
class PlotView {
 public:
  PlotView(const Box& window, double longer_side, const std::vector<LegendEntry>& legend, bool has_bar);

  const Box& window() const { return window_; }
  const Box& frame() const { return frame_; }  ///< in pixels
  double scale() const { return scale_; }      ///< pixels for a unit of length
  double width() const { return width_; }
  double height() const { return height_; }
  Point pixel(Point p) const {
    return {frame_.low.x + scale_ * (p.x - window_.low.x), frame_.high.y - scale_ * (p.y - window_.low.y)};
  }

  /// The part of a cell or edge that can be seen, with some room around, so that no coordinate is too large
  /// to draw.
  std::vector<Point> visible_part(std::vector<Point> corners) const;
  std::optional<std::array<Point, 2>> visible_part(Point a, Point b) const;

  void draw_axes(Canvas& canvas) const;
  void draw_legend(Canvas& canvas, const std::vector<LegendEntry>& legend) const;
  void draw_bar(Canvas& canvas, const ColourBar& bar) const;

 private:
  std::vector<Point> legend_places(const std::vector<LegendEntry>& legend, double& bottom) const;

  Box window_, frame_;
  double scale_ = 1, width_ = 0, height_ = 0;
};

}  // namespace quadloop
