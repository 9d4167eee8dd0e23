#include "io/plot/streamlines.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <optional>

namespace quadloop::io {

namespace {

constexpr double line_step = 1.5;    ///< pixels along a line
constexpr double too_close = 0.5;    ///< fraction of the distance at which a line ends
constexpr double least_length = 25;  ///< pixels; shorter lines are omitted

class Tracer {
 public:
  Tracer(const ValueRaster& x_velocity, const ValueRaster& y_velocity, double distance)
      : x_velocity_{x_velocity},
        y_velocity_{y_velocity},
        box_{x_velocity.box()},
        distance_{distance},
        across_{static_cast<int>(box_.width() / distance) + 1},
        buckets_(static_cast<std::size_t>(across_) * (static_cast<int>(box_.height() / distance) + 1)) {}

  /// Lines start at the centre, then beside existing ones, then wherever there is space.
  std::vector<std::vector<Point>> trace() {
    std::vector<std::vector<Point>> lines;
    std::deque<Point> seeds{box_.centre()};
    for (double y = 0.5; y * distance_ < box_.height(); ++y) {
      for (double x = 0.5; x * distance_ < box_.width(); ++x)
        seeds.push_back(box_.low + distance_ * Point{x, y});
    }
    while (!seeds.empty()) {
      const Point seed = seeds.front();
      seeds.pop_front();
      std::vector<Point> line = line_through(seed);
      if (static_cast<double>(line.size()) * line_step < least_length) continue;
      for (const Point p : line) bucket(p)->push_back(p);
      const std::vector<Point> beside = seeds_beside(line);
      seeds.insert(seeds.begin(), beside.begin(), beside.end());
      lines.push_back(std::move(line));
    }
    return lines;
  }

 private:
  std::vector<Point>* bucket(Point p) {
    if (!box_.contains(p)) return nullptr;
    const int x = static_cast<int>((p.x - box_.low.x) / distance_),
              y = static_cast<int>((p.y - box_.low.y) / distance_);
    return &buckets_[static_cast<std::size_t>(y) * across_ + x];
  }

  bool is_free(Point at, double within) {
    for (int i = -1; i <= 1; ++i) {
      for (int j = -1; j <= 1; ++j) {
        const std::vector<Point>* const near = bucket(at + distance_ * Point{1.0 * i, 1.0 * j});
        if (near == nullptr) continue;
        if (std::ranges::any_of(*near, [&](Point p) { return length(p - at) < within; })) return false;
      }
    }
    return true;
  }

  /// Returns a unit vector on the sheet; empty if there is no flow.
  std::optional<Point> direction(Point at) const {
    const Point velocity{x_velocity_.at(at), -y_velocity_.at(at)};
    const double speed = length(velocity);
    if (!(speed > 0) || !std::isfinite(speed)) return {};
    return (1 / speed) * velocity;
  }

  /// Returns the line from the seed, excluding it, as far as there is space; `sense` is 1 along the flow, -1
  /// against it.
  std::vector<Point> half_line(Point seed, double sense) {
    std::vector<Point> points;
    const auto most = static_cast<std::size_t>(4 * (box_.width() + box_.height()) / line_step);
    Point at = seed;
    while (points.size() < most) {
      const std::optional<Point> first = direction(at);
      if (!first) break;
      const std::optional<Point> middle = direction(at + 0.5 * sense * line_step * *first);
      if (!middle || dot(*first, *middle) < 0) break;
      at = at + sense * line_step * *middle;
      if (!box_.contains(at) || !is_free(at, too_close * distance_)) break;
      if (points.size() > 8 && length(at - seed) < line_step) break;  // closed
      points.push_back(at);
    }
    return points;
  }

  std::vector<Point> line_through(Point seed) {
    if (!direction(seed) || !is_free(seed, 0.99 * distance_)) return {};
    std::vector<Point> line = half_line(seed, -1);
    std::ranges::reverse(line);
    line.push_back(seed);
    std::ranges::copy(half_line(seed, 1), std::back_inserter(line));
    return line;
  }

  std::vector<Point> seeds_beside(const std::vector<Point>& line) const {
    std::vector<Point> seeds;
    const auto stride = std::max<std::size_t>(1, static_cast<std::size_t>(distance_ / line_step));
    for (std::size_t i = 1; i < line.size(); i += stride) {
      const Point along = line[i] - line[i - 1];
      const double size = length(along);
      if (size == 0) continue;
      const Point across = distance_ / size * Point{-along.y, along.x};
      seeds.push_back(line[i] + across);
      seeds.push_back(line[i] - across);
    }
    return seeds;
  }

  const ValueRaster &x_velocity_, &y_velocity_;
  Box box_;
  double distance_;
  int across_;
  std::vector<std::vector<Point>> buckets_;  ///< points of lines in each square of that size
};

}  // namespace

std::vector<std::vector<Point>> streamlines(const ValueRaster& x_velocity, const ValueRaster& y_velocity,
                                            int count) {
  const Box& box = x_velocity.box();
  const double distance = std::max(4.0, std::min(box.width(), box.height()) / count);
  return Tracer(x_velocity, y_velocity, distance).trace();
}

}  // namespace quadloop::io
