#include "io/plot/plot_view.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/plot/canvas/ticks.hpp"

namespace quadloop::io {

namespace {

constexpr double narrowest = 420;
constexpr double left = 106, right = 28, right_with_bar = 150, top = 24, below_axis = 64, legend_row = 27,
                 swatch = 24, gap = 26;
constexpr double room =
    64;  // pixels around the frame that are still drawn, so that clipped edges are not visible
constexpr Colour ink{0.2, 0.2, 0.2};

/// Returns the part of a convex polygon where side(p) >= 0; `side` is linear.
template <class Side>
std::vector<Point> cut_off(const std::vector<Point>& corners, Side side) {
  std::vector<Point> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point a = corners[i], b = corners[(i + 1) % corners.size()];
    const double at_a = side(a), at_b = side(b);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a >= 0) != (at_b >= 0)) kept.push_back(a + at_a / (at_a - at_b) * (b - a));
  }
  return kept;
}

Box with_room(const Box& window, double pixels, double scale) {
  const Point margin{pixels / scale, pixels / scale};
  return {window.low - margin, window.high + margin};
}

}  // namespace

PlotView::PlotView(const Box& window, double longer_side, const std::vector<LegendEntry>& legend,
                   bool has_bar, std::optional<Point> sheet)
    : window_{window} {
  const Point most = sheet ? *sheet : Point{longer_side, longer_side};
  const double beside = left + (has_bar ? right_with_bar : right);
  double below = below_axis + legend_row;
  for (int pass = 0; pass < 3; ++pass) {  // the number of legend rows and the width depend on each other
    scale_ = std::min((most.x - beside) / window.width(), (most.y - top - below) / window.height());
    const double wide = std::max(1.0, scale_ * window.width()),
                 high = std::max(1.0, scale_ * window.height());
    frame_ = {{left, top}, {left + wide, top + high}};
    width_ = sheet ? sheet->x : std::round(std::max(narrowest, beside + wide));
    double bottom = 0;
    legend_places(legend, bottom);
    below = bottom - frame_.high.y;
    height_ = sheet ? sheet->y : std::round(bottom);
  }
}

Box PlotView::filling(const Box& window, Point sheet, bool has_bar) {
  const double wide = sheet.x - left - (has_bar ? right_with_bar : right),
               high = sheet.y - top - below_axis - legend_row - 6;
  if (!(wide > 1 && high > 1)) return window;
  const Point grown{std::max(0.0, window.height() * wide / high - window.width()),
                    std::max(0.0, window.width() * high / wide - window.height())};
  return {window.low - 0.5 * grown, window.high + 0.5 * grown};
}

std::vector<Point> PlotView::legend_places(const std::vector<LegendEntry>& legend, double& bottom) const {
  const Canvas ruler(Strips::one(PlotFormat::png, 1, 1));
  std::vector<Point> places;
  Point at{left, frame_.high.y + below_axis + 0.5 * legend_row};
  for (const LegendEntry& entry : legend) {
    const double needed = swatch + 8 + ruler.text_width(entry.name);
    if (at.x > left && at.x + needed > width_ - 8) at = {left, at.y + legend_row};
    places.push_back(at);
    at.x += needed + gap;
  }
  bottom = at.y + 0.5 * legend_row + 6;
  return places;
}

std::vector<Point> PlotView::visible_part(std::vector<Point> corners) const {
  const Box seen = with_room(window_, room, scale_);
  if (std::all_of(corners.begin(), corners.end(), [&](Point p) { return seen.contains(p); })) return corners;
  corners = cut_off(corners, [&](Point p) { return p.x - seen.low.x; });
  corners = cut_off(corners, [&](Point p) { return seen.high.x - p.x; });
  corners = cut_off(corners, [&](Point p) { return p.y - seen.low.y; });
  return cut_off(corners, [&](Point p) { return seen.high.y - p.y; });
}

std::optional<std::array<Point, 2>> PlotView::visible_part(Point a, Point b) const {
  return part_within(with_room(window_, room, scale_), a, b);
}

std::optional<std::array<Point, 2>> part_within(const Box& box, Point a, Point b) {
  if (box.contains(a) && box.contains(b)) return std::array{a, b};
  double from = 0, to = 1;
  const auto narrow = [&](double at_a, double at_b) {
    if (at_a < 0 && at_b < 0) to = -1;
    if (at_a < 0 && at_b >= 0) from = std::max(from, at_a / (at_a - at_b));
    if (at_a >= 0 && at_b < 0) to = std::min(to, at_a / (at_a - at_b));
  };
  narrow(a.x - box.low.x, b.x - box.low.x);
  narrow(box.high.x - a.x, box.high.x - b.x);
  narrow(a.y - box.low.y, b.y - box.low.y);
  narrow(box.high.y - a.y, box.high.y - b.y);
  if (from > to) return std::nullopt;
  return std::array{a + from * (b - a), a + to * (b - a)};
}

void PlotView::draw_axes(Canvas& canvas, const std::string& x_title, const std::string& y_title) const {
  const Box& f = frame_;
  const std::array<Point, 4> corners{f.low, Point{f.high.x, f.low.y}, f.high, Point{f.low.x, f.high.y}};
  canvas.add_polygon(corners);
  const Ticks along_x = round_ticks(window_.low.x, window_.high.x, f.width() / 90);
  for (std::size_t i = 0; i < along_x.values.size(); ++i) {
    const double x = pixel({along_x.values[i], window_.low.y}).x;
    canvas.add_line({x, f.high.y}, {x, f.high.y + 7});
  }
  const Ticks along_y = round_ticks(window_.low.y, window_.high.y, f.height() / 60);
  for (std::size_t i = 0; i < along_y.values.size(); ++i) {
    const double y = pixel({window_.low.x, along_y.values[i]}).y;
    canvas.add_line({f.low.x - 7, y}, {f.low.x, y});
  }
  canvas.stroke(ink, 1, 1.2);
  for (std::size_t i = 0; i < along_x.values.size(); ++i)
    canvas.text({pixel({along_x.values[i], window_.low.y}).x, f.high.y + 21}, along_x.labels[i],
                TextAlign::centre);
  for (std::size_t i = 0; i < along_y.values.size(); ++i)
    canvas.text({f.low.x - 13, pixel({window_.low.x, along_y.values[i]}).y}, along_y.labels[i],
                TextAlign::right);
  canvas.text({0.5 * (f.low.x + f.high.x), f.high.y + 45}, x_title, TextAlign::centre);
  canvas.text_upwards({16, 0.5 * (f.low.y + f.high.y)}, y_title);
}

void PlotView::draw_legend(Canvas& canvas, const std::vector<LegendEntry>& legend) const {
  double bottom = 0;
  const std::vector<Point> places = legend_places(legend, bottom);
  for (std::size_t i = 0; i < legend.size(); ++i) {
    const Point at = places[i];
    const double half = legend[i].is_line ? 2 : 7;
    const std::array<Point, 4> corners{at + Point{0, -half}, at + Point{swatch, -half},
                                       at + Point{swatch, half}, at + Point{0, half}};
    canvas.add_polygon(corners);
    canvas.fill_crisp(legend[i].colour);
    if (!legend[i].is_line) {
      canvas.add_polygon(corners);
      canvas.stroke(ink, 0.6, 0.8);
    }
    canvas.text(at + Point{swatch + 8, 0}, legend[i].name);
  }
}

void PlotView::draw_bar(Canvas& canvas, const ColourBar& bar) const {
  constexpr int steps = 128;
  const double x = frame_.high.x + 24, wide = 22;
  const double low = frame_.high.y, high = std::min(frame_.low.y + 10, low - 40);
  const auto at = [&](double t) { return low + t * (high - low); };
  const auto add_part = [&](double from, double to) {
    canvas.add_polygon(
        std::array{Point{x, at(from)}, Point{x + wide, at(from)}, Point{x + wide, at(to)}, Point{x, at(to)}});
  };
  for (int i = 0; i < steps; ++i) {
    add_part(static_cast<double>(i) / steps, static_cast<double>(i + 1) / steps);
    canvas.fill_crisp(bar.colour((i + 0.5) / steps));
  }
  add_part(0, 1);
  canvas.stroke(ink, 1, 1);
  const Ticks ticks = round_ticks(bar.low, bar.high, (low - high) / 45);
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double y = at((ticks.values[i] - bar.low) / (bar.high - bar.low));
    canvas.add_line({x + wide, y}, {x + wide + 5, y});
    canvas.stroke(ink, 1, 1);
    canvas.text({x + wide + 10, y}, ticks.labels[i]);
  }
  const double title = canvas.text_width(bar.title);
  canvas.text({std::min(x, width_ - 8 - title), 0.5 * top}, bar.title);
}

}  // namespace quadloop::io
