#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/layers/columns_on_wall.hpp"
#include "mesher/layers/wall_line.hpp"

namespace quadloop {

/// The line on which the layers end and the other cells begin, with what lies between it and the wall.
struct LayerFront {
  WallLine line;
  std::vector<double> thickness;  ///< of the layers at each station, normal to the wall: as asked or less
  WallColumns columns;
  std::vector<Point> points;  ///< of the front, one for each station

  /// The outline of the domain outside the layers: the front in the place of the wall, with the wall's
  /// boundaries.
  Geometry outer;
  /// Of each of outer's segments: the station where it begins, or WallLine::none where it is no front.
  std::vector<std::int32_t> station_of;
};

/// The front of all boundaries that ask for layers. Layers are thinner where walls come close to each other
/// or turn sharply into the domain, so that no two columns meet, and each wall keeps room for cells outside;
/// both are proved with exact signs. `curvature`: degrees that the wall may turn along one cell. A function
/// of the geometry alone; mirror images have mirrored fronts. Throws InputError, naming the place, where no
/// layers fit. `geometry` must outlive the result.
LayerFront layer_front(const Geometry& geometry, std::optional<double> curvature = {});

}  // namespace quadloop
