#include "mesher/layers/front/adapted_thickness.hpp"

namespace quadloop {

namespace {

constexpr double last_over_cell = 1.4;
constexpr double below_front = 0.8;  // of the thickness
constexpr int most_steps = 8;

/// Where the thickness follows the flow, layers may cover cells that adaptation has refined in the boundary
/// layer: only those at the front count, which moves towards the wall until the last layer fits.
double adapted_thickness(const WallLine& line, std::int32_t i, const AdaptedSize& adapted) {
  const Station& station = line[i];
  const LayerSpec& spec = line.spec(i);
  const auto above_wall = [&](double height) { return station.wall + height * station.direction; };
  double thickness = line.asked(i), last = layer_heights(spec).back();
  for (int step = 0; step < (spec.follows_flow ? most_steps : 1); ++step) {
    const double most = last / last_over_cell;
    const Point from = spec.follows_flow ? above_wall(below_front * thickness) : station.wall;
    const double size = adapted(from, above_wall(thickness), most);
    if (size >= most) break;
    last = last_over_cell * size;
    thickness = thickness_with_last(spec, last);
  }
  return thickness;
}

}  // namespace

std::vector<double> adapted_thickness(const WallLine& line, const AdaptedSize& adapted) {
  std::vector<double> thickness;
  for (std::int32_t i = 0; i < line.size(); ++i) thickness.push_back(adapted_thickness(line, i, adapted));
  return thickness;
}

}  // namespace quadloop
