#include "io/plot/canvas/chart.hpp"

#include <algorithm>
#include <cmath>

#include "io/plot/canvas/sheet.hpp"
#include "io/plot/canvas/ticks.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

constexpr double chart_left = 110, chart_right = 28, chart_top = 24, chart_gap = 22, chart_below = 62,
                 chart_legend_row = 27, chart_swatch = 30;
constexpr Colour chart_ink{0.2, 0.2, 0.2}, grid_ink{0.86, 0.86, 0.88}, mark_ink{0.6, 0.6, 0.62};

Colour line_colour(std::size_t i) {
  static constexpr std::array<Colour, 8> colours{{{0.10, 0.36, 0.70},
                                                  {0.78, 0.11, 0.14},
                                                  {0.10, 0.52, 0.24},
                                                  {0.85, 0.44, 0.02},
                                                  {0.48, 0.23, 0.62},
                                                  {0.00, 0.55, 0.58},
                                                  {0.45, 0.29, 0.14},
                                                  {0.30, 0.34, 0.42}}};
  return colours[i % colours.size()];
}

/// Maps values to positions along an axis, 0 to 1.
class Scale {
 public:
  Scale(const ChartAxis& axis, const std::vector<double>& values) : axis_{axis} {
    if (axis.range) {
      low_ = (*axis.range)[0];
      high_ = (*axis.range)[1];
      if (shows(low_)) return;
    }
    bool any = false;
    for (const double value : values) {
      if (!shows(value)) continue;
      low_ = any ? std::min(low_, value) : value;
      high_ = any ? std::max(high_, value) : value;
      any = true;
    }
    if (!any) throw InputError("there is no value of '" + axis.title + "' to draw");
    widen();
  }

  bool shows(double value) const { return std::isfinite(value) && (!axis_.logarithmic || value > 0); }

  double at(double value) const {
    const double share = (measure(value) - measure(low_)) / (measure(high_) - measure(low_));
    return axis_.reversed ? 1 - share : share;
  }

  Ticks ticks(double most) const {
    if (axis_.logarithmic && high_ / low_ >= 10) return decade_ticks(low_, high_, most);
    return round_ticks(low_, high_, most);
  }

 private:
  double measure(double value) const { return axis_.logarithmic ? std::log10(value) : value; }

  void widen() {
    if (axis_.logarithmic) {
      const double factor = std::pow(high_ / low_, 0.04) * (high_ > low_ ? 1 : 2);
      low_ /= factor;
      high_ *= factor;
      return;
    }
    const double around = high_ > low_ ? 0.04 * (high_ - low_) : std::max(1e-3 * std::abs(low_), 1e-9);
    low_ -= around;
    high_ += around;
  }

  const ChartAxis& axis_;
  double low_ = 0, high_ = 1;
};

class ChartPicture {
 public:
  ChartPicture(const Chart& chart, Point size, double scale, PlotFormat format)
      : chart_{chart},
        size_{size},
        canvas_(Strips::one(format, size.x, size.y, scale)),
        names_{names_in(chart)},
        x_(chart.x, values_of(&Point::x, chart.panels)) {}

  std::string draw() {
    const std::vector<Point> places = legend_places();
    const double legend = has_legend() ? places.back().y - places.front().y + chart_legend_row : 8;
    const auto count = static_cast<double>(chart_.panels.size());
    const double high =
        std::max(20.0, (size_.y - chart_top - chart_below - legend - chart_gap * (count - 1)) / count);
    for (std::size_t i = 0; i < chart_.panels.size(); ++i) {
      const double from = chart_top + static_cast<double>(i) * (high + chart_gap);
      draw_panel(chart_.panels[i], {{chart_left, from}, {size_.x - chart_right, from + high}},
                 i + 1 == chart_.panels.size());
    }
    if (has_legend()) draw_legend(places, size_.y - legend + 0.5 * chart_legend_row - 4);
    return canvas_.finish();
  }

 private:
  static std::vector<std::string> names_in(const Chart& chart) {
    std::vector<std::string> names;
    for (const ChartPanel& panel : chart.panels) {
      for (const ChartLine& line : panel.lines) {
        if (std::ranges::find(names, line.name) == names.end()) names.push_back(line.name);
      }
    }
    return names;
  }

  /// Whether a legend is needed because a panel's title does not identify its lines.
  bool has_legend() const {
    return std::ranges::any_of(chart_.panels, [](const ChartPanel& panel) {
      return std::ranges::any_of(
          panel.lines, [&](const ChartLine& line) { return line.name != panel.lines.front().name; });
    });
  }

  static std::vector<double> values_of(double Point::*coordinate, std::span<const ChartPanel> panels) {
    std::vector<double> values;
    for (const ChartPanel& panel : panels) {
      for (const ChartLine& line : panel.lines) {
        for (const Point& p : line.points) values.push_back(p.*coordinate);
      }
    }
    return values;
  }

  void draw_panel(const ChartPanel& panel, const Box& frame, bool is_last) {
    const Scale y(panel.y, values_of(&Point::y, std::span(&panel, 1)));
    const auto across = [&](double value) { return frame.low.x + x_.at(value) * frame.width(); };
    const auto up = [&](double value) { return frame.high.y - y.at(value) * frame.height(); };
    const Ticks x_ticks = x_.ticks(frame.width() / 85), y_ticks = y.ticks(frame.height() / 36);
    for (const double value : x_ticks.values)
      canvas_.add_line({across(value), frame.low.y}, {across(value), frame.high.y});
    for (const double value : y_ticks.values)
      canvas_.add_line({frame.low.x, up(value)}, {frame.high.x, up(value)});
    canvas_.stroke(grid_ink, 1, 1);
    canvas_.clip(frame);
    for (const double mark : chart_.flags)
      canvas_.add_line({across(mark), frame.low.y}, {across(mark), frame.high.y});
    canvas_.stroke(mark_ink, 1, 1);
    for (const ChartLine& line : panel.lines) draw_line(line, y, across, up);
    canvas_.unclip();
    canvas_.add_polygon(std::array{frame.low, Point{frame.high.x, frame.low.y}, frame.high,
                                   Point{frame.low.x, frame.high.y}});
    canvas_.stroke(chart_ink, 1, 1.2);
    for (std::size_t i = 0; i < y_ticks.values.size(); ++i)
      canvas_.text({frame.low.x - 9, up(y_ticks.values[i])}, y_ticks.labels[i], TextAlign::right);
    canvas_.text_upwards({18, 0.5 * (frame.low.y + frame.high.y)}, panel.y.title);
    if (!is_last) return;
    for (std::size_t i = 0; i < x_ticks.values.size(); ++i)
      canvas_.text({across(x_ticks.values[i]), frame.high.y + 17}, x_ticks.labels[i], TextAlign::centre);
    canvas_.text({0.5 * (frame.low.x + frame.high.x), frame.high.y + 42}, chart_.x.title, TextAlign::centre);
  }

  /// Interrupted at values that the axes cannot show.
  template <class Across, class Up>
  void draw_line(const ChartLine& line, const Scale& y, const Across& across, const Up& up) {
    const auto number = std::ranges::find(names_, line.name) - names_.begin();
    std::vector<Point> run;
    const auto finish_run = [&] {
      canvas_.add_polyline(run);
      run.clear();
    };
    for (const Point& p : line.points) {
      if (!x_.shows(p.x) || !y.shows(p.y)) {
        finish_run();
        continue;
      }
      // Cairo's coordinates are limited.
      run.push_back({std::clamp(across(p.x), -1e5, 1e5), std::clamp(up(p.y), -1e5, 1e5)});
    }
    finish_run();
    canvas_.stroke(line_colour(number), 1, 2);
  }

  /// Positions relative to the first row.
  std::vector<Point> legend_places() const {
    std::vector<Point> places;
    Point at{chart_left, 0};
    for (const std::string& name : names_) {
      const double needed = chart_swatch + 8 + canvas_.text_width(name);
      if (at.x > chart_left && at.x + needed > size_.x - 8) at = {chart_left, at.y + chart_legend_row};
      places.push_back(at);
      at.x += needed + 26;
    }
    return places;
  }

  void draw_legend(const std::vector<Point>& places, double first_row) {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const Point at = places[i] + Point{0, first_row};
      canvas_.add_line(at, at + Point{chart_swatch, 0});
      canvas_.stroke(line_colour(i), 1, 2.5);
      canvas_.text(at + Point{chart_swatch + 8, 0}, names_[i]);
    }
  }

  const Chart& chart_;
  Point size_;
  Canvas canvas_;
  std::vector<std::string> names_;
  Scale x_;
};

}  // namespace

std::string draw_chart(const Chart& chart, double size, std::optional<Point> centimetres, PlotFormat format) {
  const Sheet sheet = sheet_of(centimetres, format);
  const double shape = std::min(1.0, 0.4 + 0.2 * static_cast<double>(chart.panels.size()));
  const Point whole = sheet.size ? *sheet.size : Point{size, std::round(shape * size)};
  return ChartPicture(chart, whole, sheet.scale, format).draw();
}

}  // namespace quadloop::io
