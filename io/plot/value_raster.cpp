#include "io/plot/value_raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace quadloop::io {

namespace {

constexpr double piece_size = 20;  ///< pixels of the sheet
constexpr int most_divisions = 64;
constexpr float none = std::numeric_limits<float>::quiet_NaN(),
                not_finite = std::numeric_limits<float>::infinity();

/// A point of a quadrilateral with its bilinear value.
struct Sample {
  Point at;
  double value = 0;
};

struct Quadrilateral {
  std::array<Point, 4> corners;
  std::array<double, 4> values;

  Sample sample(double s, double t) const {
    const std::array<double, 4> weights{(1 - s) * (1 - t), s * (1 - t), s * t, (1 - s) * t};
    Sample sample;
    for (std::size_t k = 0; k < 4; ++k) {
      sample.at = sample.at + weights[k] * corners[k];
      sample.value += weights[k] * values[k];
    }
    return sample;
  }
};

/// Number of divisions, limited for large cells by the size of the sheet.
int divisions(const Quadrilateral& quad, const PlotView& view) {
  double longest = 0;
  for (std::size_t k = 0; k < 4; ++k)
    longest = std::max(longest, length(quad.corners[(k + 1) % 4] - quad.corners[k]));
  const double twist = quad.values[0] - quad.values[1] + quad.values[2] - quad.values[3];
  if (twist == 0) return 1;
  const double most = std::max(view.width(), view.height());
  return std::clamp(static_cast<int>(std::ceil(std::min(longest, most) / piece_size)), 1, most_divisions);
}

/// Adds four triangles around the centre.
void append_quadrilateral(const Quadrilateral& quad, int n, std::vector<LinearPiece>& pieces) {
  const double step = 1.0 / n;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double s = i * step, t = j * step;
      const std::array<Sample, 4> round{quad.sample(s, t), quad.sample(s + step, t),
                                        quad.sample(s + step, t + step), quad.sample(s, t + step)};
      const Sample middle = quad.sample(s + 0.5 * step, t + 0.5 * step);
      for (std::size_t k = 0; k < 4; ++k) {
        const Sample &a = round[k], &b = round[(k + 1) % 4];
        pieces.push_back({{a.at, b.at, middle.at}, {a.value, b.value, middle.value}});
      }
    }
  }
}

/// Narrows the range to 0 <= a + b x on a row. An edge parallel to the row does not limit it: rows beyond it
/// are not visited.
void narrow(double a, double b, double& low, double& high) {
  constexpr double rounding = 1e-9;  // adjacent pieces leave no pixel out
  if (std::abs(b) < 1e-300) return;
  if (b > 0) {
    low = std::max(low, -a / b - rounding);
  } else {
    high = std::min(high, -a / b + rounding);
  }
}

std::uint32_t packed(Colour colour) {
  const auto byte = [](double share) { return static_cast<std::uint32_t>(std::lround(255 * share)); };
  return 0xff000000U | byte(colour.red) << 16U | byte(colour.green) << 8U | byte(colour.blue);
}

}  // namespace

void append_pieces(const PlotView& view, const ShownCell& cell, std::vector<LinearPiece>& pieces) {
  Quadrilateral quad{cell.corners, cell.values};
  for (Point& corner : quad.corners) corner = view.pixel(corner);
  if (cell.width == 3) {
    pieces.push_back({{quad.corners[0], quad.corners[1], quad.corners[2]},
                      {quad.values[0], quad.values[1], quad.values[2]}});
  } else {
    append_quadrilateral(quad, divisions(quad, view), pieces);
  }
}

ValueRaster::ValueRaster(const Box& frame, double resolution) : resolution_{resolution} {
  const auto down = [&](double at) { return std::floor(at * resolution); };
  const auto up = [&](double at) { return std::ceil(at * resolution); };
  const Point low{down(frame.low.x), down(frame.low.y)}, high{up(frame.high.x), up(frame.high.y)};
  width_ = static_cast<int>(high.x - low.x);
  height_ = static_cast<int>(high.y - low.y);
  box_ = {(1 / resolution) * low, (1 / resolution) * high};
  values_.assign(static_cast<std::size_t>(width_) * height_, none);
}

void ValueRaster::add(const LinearPiece& piece) {
  std::array<Point, 3> p{};
  for (std::size_t k = 0; k < 3; ++k) p[k] = resolution_ * (piece.corners[k] - box_.low) - Point{0.5, 0.5};
  const double twice = cross(p[1] - p[0], p[2] - p[0]);
  if (!(std::abs(twice) > 0) || !std::isfinite(twice)) return;
  const auto [bottom, top] = std::minmax({p[0].y, p[1].y, p[2].y});
  const double first = std::max(0.0, std::ceil(bottom)), last = std::min(height_ - 1.0, std::floor(top));
  const bool is_finite = std::all_of(piece.values.begin(), piece.values.end(),
                                     [](double value) { return std::isfinite(value); });
  for (double y = first; y <= last; ++y) {
    double low = 0, high = width_ - 1.0;
    std::array<double, 3> at_zero{}, slope{};  // of the three barycentric coordinates along the row
    for (std::size_t k = 0; k < 3; ++k) {
      const Point a = p[(k + 1) % 3], along = p[(k + 2) % 3] - a;
      at_zero[k] = (along.x * (y - a.y) + along.y * a.x) / twice;
      slope[k] = -along.y / twice;
      narrow(at_zero[k], slope[k], low, high);
    }
    for (double x = std::ceil(low); x <= high; ++x) {
      double value = 0;
      for (std::size_t k = 0; k < 3; ++k) value += (at_zero[k] + slope[k] * x) * piece.values[k];
      values_[index(static_cast<int>(x), static_cast<int>(y))] =
          is_finite ? static_cast<float>(value) : not_finite;
    }
  }
}

double ValueRaster::at(Point place) const {
  const Point p = resolution_ * (place - box_.low) - Point{0.5, 0.5};
  const double x = std::floor(p.x), y = std::floor(p.y);
  if (!(x >= 0 && y >= 0 && x + 1 < width_ && y + 1 < height_)) return none;
  const std::size_t i = index(static_cast<int>(x), static_cast<int>(y)), above = i + width_;
  const double s = p.x - x, t = p.y - y;
  return (1 - t) * ((1 - s) * values_[i] + s * values_[i + 1]) +
         t * ((1 - s) * values_[above] + s * values_[above + 1]);
}

Image ValueRaster::image(const ColourBar& bar) const {
  constexpr std::size_t steps = 1024;
  std::vector<std::uint32_t> colours;
  for (std::size_t i = 0; i < steps; ++i)
    colours.push_back(packed(bar.colour(static_cast<double>(i) / (steps - 1))));
  const std::uint32_t grey = packed({0.6, 0.6, 0.6});
  Image image{width_, height_, {}};
  image.pixels.reserve(values_.size());
  for (const float value : values_) {
    const double t = std::clamp((value - bar.low) / (bar.high - bar.low), 0.0, 1.0);
    image.pixels.push_back(std::isnan(value)   ? 0
                           : std::isinf(value) ? grey
                                               : colours[static_cast<std::size_t>(t * (steps - 1) + 0.5)]);
  }
  return image;
}

}  // namespace quadloop::io
