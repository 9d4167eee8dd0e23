#include "mesher/layers/front/adapted_thickness.hpp"

namespace quadloop {

namespace {

constexpr double last_over_cell = 1.4;

double adapted_thickness(const WallLine& line, std::int32_t i, const AdaptedSize& adapted) {
  const Station& station = line[i];
  const double asked = line.asked(i), most = layer_heights(line.spec(i)).back() / last_over_cell;
  const double size = adapted(station.wall, station.wall + asked * station.direction, most);
  return size < most ? thickness_with_last(line.spec(i), last_over_cell * size) : asked;
}

}  // namespace

std::vector<double> adapted_thickness(const WallLine& line, const AdaptedSize& adapted) {
  std::vector<double> thickness;
  for (std::int32_t i = 0; i < line.size(); ++i) thickness.push_back(adapted_thickness(line, i, adapted));
  return thickness;
}

}  // namespace quadloop
