#include "mesher/layers/front/followed_layers.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {

namespace {

constexpr double most_over_estimate = 10;
constexpr double steepest_following = 0.6;  // of a height, per thickness of the layers along the wall

/// Finds the measurement near a station.
class Measurements {
 public:
  explicit Measurements(const MeasuredWall& wall) : wall_{wall} {
    std::vector<Box> boxes;
    for (const MeasuredEdge& edge : wall) boxes.push_back(box_of(edge.from, edge.to));
    tree_ = BoxTree(boxes);
  }

  /// Wall units per unit of length; negative where there is no measurement.
  double wall_units(const Station& station) const {
    const auto distance = [&](std::int32_t k) {
      const Point along = wall_[k].to - wall_[k].from;
      const bool same_way = dot(along, station.before) > 0 || dot(along, station.after) > 0;
      return same_way ? place_on_segment(station.wall, wall_[k].from, wall_[k].to).squared_distance
                      : std::numeric_limits<double>::infinity();
    };
    const std::int32_t nearest = tree_.nearest(station.wall, distance);
    if (nearest == BoxTree::none || distance(nearest) == std::numeric_limits<double>::infinity()) return -1;
    const MeasuredEdge& edge = wall_[nearest];
    const double on = place_on_segment(station.wall, edge.from, edge.to).parameter,
                 back = place_on_segment(station.wall, edge.to, edge.from).parameter;
    return 0.5 * ((edge.wall_units_from + on * (edge.wall_units_to - edge.wall_units_from)) +
                  (edge.wall_units_to + back * (edge.wall_units_from - edge.wall_units_to)));
  }

 private:
  const MeasuredWall& wall_;
  BoxTree tree_;
};

double target_height(const LayerSpec& spec, double wall_units) {
  if (spec.y_plus <= 0 || wall_units < 0) return spec.first;
  const double least = spec.first / most_over_estimate, most = spec.first * most_over_estimate;
  const double height = wall_units * most > spec.y_plus ? spec.y_plus / wall_units : most;
  return std::min(std::max(height, least), layers_thickness(spec) / spec.count);
}

/// Limits each height to the growth allowed from every other station along the wall.
void limit_growth(const WallLine& line, std::span<double> heights) {
  const auto limit = [&](std::int32_t from, std::int32_t to, double width) {
    const LayerSpec& spec = line.spec(to);
    if (spec.y_plus > 0)
      heights[to] =
          std::min(heights[to], heights[from] * (1 + steepest_following * width / layers_thickness(spec)));
  };
  for (int round = 0; round < 2; ++round) {  // a closed run needs a second round
    for (std::int32_t i = 0; i < line.size(); ++i) {
      if (const std::int32_t next = line.next(i); next != WallLine::none) limit(i, next, line.width(i));
    }
    for (std::int32_t i = line.size() - 1; i >= 0; --i) {
      if (const std::int32_t previous = line.previous(i); previous != WallLine::none)
        limit(i, previous, line.width(previous));
    }
  }
}

}  // namespace

std::vector<LayerSpec> followed_layers(const WallLine& line, const MeasuredWall& measured) {
  const Measurements measurements(measured);
  std::vector<double> heights;
  for (std::int32_t i = 0; i < line.size(); ++i)
    heights.push_back(target_height(line.spec(i), measurements.wall_units(line[i])));
  limit_growth(line, heights);
  std::vector<LayerSpec> layers;
  for (std::int32_t i = 0; i < line.size(); ++i) {
    const LayerSpec& spec = line.spec(i);
    layers.push_back(spec.y_plus > 0 ? with_first_height(spec, heights[i]) : spec);
  }
  return layers;
}

}  // namespace quadloop
