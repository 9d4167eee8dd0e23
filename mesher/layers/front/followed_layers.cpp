#include "mesher/layers/front/followed_layers.hpp"

#include <algorithm>
#include <span>

#include "mesher/layers/front/values_along_wall.hpp"

namespace quadloop {

namespace {

constexpr double most_over_estimate = 10;
constexpr double thickness_over_measured = 1.2;
constexpr double steepest_following = 0.6;  // of a height, per thickness of the layers along the wall

/// The measurements near a station.
class Measurements {
 public:
  explicit Measurements(const MeasuredFlow& flow) : friction_(flow.walls), thickness_(flow.thickness) {}

  /// Wall units per unit of length; negative where there is no measurement.
  double wall_units(const Station& station) const {
    return friction_
        .at(station.wall, station.before, station.after, &MeasuredEdge::wall_units_from,
            &MeasuredEdge::wall_units_to)
        .value_or(-1);
  }
  /// The thickness of the boundary layer; 0 where it is unknown.
  double thickness(const Station& station) const {
    return thickness_
        .at(station.wall, station.before, station.after, &MeasuredThickness::at_from,
            &MeasuredThickness::at_to)
        .value_or(0);
  }

 private:
  ValuesAlongWall<MeasuredEdge> friction_;
  ValuesAlongWall<MeasuredThickness> thickness_;
};

double target_height(const LayerSpec& spec, double wall_units) {
  if (spec.y_plus <= 0 || wall_units < 0) return spec.first;
  const double least = spec.first / most_over_estimate, most = spec.first * most_over_estimate;
  const double height = wall_units * most > spec.y_plus ? spec.y_plus / wall_units : most;
  return std::min(std::max(height, least), layers_thickness(spec) / spec.count);
}

bool follows(const LayerSpec& spec, double measured_thickness) {
  return spec.follows_flow && measured_thickness > 0;
}

/// The requested thickness, or where it is known that of the boundary layer.
double target_thickness(const LayerSpec& spec, double measured_thickness) {
  const double estimate = layers_thickness(spec);
  if (!follows(spec, measured_thickness)) return estimate;
  return std::clamp(thickness_over_measured * measured_thickness, estimate / most_over_estimate,
                    estimate * most_over_estimate);
}

/// Limits each height to the growth allowed from every other station along the wall.
void limit_growth(const WallLine& line, std::span<const double> thickness, std::span<double> heights) {
  const auto limit = [&](std::int32_t from, std::int32_t to, double width) {
    if (line.spec(to).y_plus > 0)
      heights[to] = std::min(heights[to], heights[from] * (1 + steepest_following * width / thickness[to]));
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

/// Layers of at least this thickness whose last one is as high as the cells that adaptation requests at the
/// front, as far as the boundary's own thickness allows. Cells get larger with the distance from the wall, so
/// the front moves outwards in steps.
LayerSpec as_high_as_cells(const Station& station, const LayerSpec& spec, double first, double thickness,
                           const AdaptedSize& adapted) {
  constexpr int steps_outwards = 8;
  constexpr double outer_part = 0.8;  // the cells from here to the front are looked at
  LayerSpec layers = with_thickness(spec, first, thickness);
  if (!adapted) return layers;
  const LayerSpec thickest = with_thickness(spec, first, std::max(thickness, layers_thickness(spec)));
  const double highest = layer_heights(thickest).back();
  const auto above_wall = [&](double height) { return station.wall + height * station.direction; };
  for (int step = 0; step < steps_outwards; ++step) {
    const double reached = layers_thickness(layers),
                 size = adapted(above_wall(outer_part * reached), above_wall(reached), highest);
    if (size <= layer_heights(layers).back()) break;
    layers = with_thickness(spec, first, thickness_with_last(thickest, size));
  }
  return layers;
}

}  // namespace

std::vector<LayerSpec> followed_layers(const WallLine& line, const MeasuredFlow& measured,
                                       const AdaptedSize& adapted) {
  const Measurements measurements(measured);
  std::vector<double> heights, measured_thickness, thickness;
  for (std::int32_t i = 0; i < line.size(); ++i) {
    heights.push_back(target_height(line.spec(i), measurements.wall_units(line[i])));
    measured_thickness.push_back(measurements.thickness(line[i]));
    thickness.push_back(target_thickness(line.spec(i), measured_thickness[i]));
  }
  limit_growth(line, thickness, heights);
  std::vector<LayerSpec> layers;
  for (std::int32_t i = 0; i < line.size(); ++i) {
    const LayerSpec& spec = line.spec(i);
    layers.push_back(follows(spec, measured_thickness[i])
                         ? as_high_as_cells(line[i], spec, heights[i], thickness[i], adapted)
                     : spec.y_plus > 0 ? with_first_height(spec, heights[i])
                                       : spec);
  }
  return layers;
}

}  // namespace quadloop
