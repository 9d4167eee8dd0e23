#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/measured_wall.hpp"
#include "mesher/layers/front/columns_on_wall.hpp"
#include "mesher/layers/front/layer_strip.hpp"
#include "mesher/layers/front/wall_line.hpp"

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
  /// Of each of outer's segments: the station where it begins, or WallLine::none where it is no wall's front.
  std::vector<std::int32_t> station_of;
  /// The same: the height of the last layer there, or 0.
  std::vector<double> last_heights;

  /// Layers on both sides of lines. Their fronts are outer's last boundary, if there are any.
  std::vector<LayerStrip> strips;
  bool has_strips() const { return !strips.empty(); }
  BoundaryId strip_boundary() const { return BoundaryId{size32(outer.boundaries()) - 1}; }
  /// Whether a segment of outer is a front, of a wall or of a strip.
  bool is_front(std::int32_t segment) const {
    return station_of[segment] != WallLine::none ||
           (has_strips() && outer.boundary_of(segment) == strip_boundary());
  }

  /// From now on these stations must be nodes of the mesh outside.
  void keep(const std::vector<std::int32_t>& stations);
};

constexpr double leaf_over_last_layer = 2;  ///< of leaves beside the front, at most

/// The size of the smallest leaves that layers on walls and on both sides of lines want where they are as
/// thick as they are asked for; infinity where there are none. Throws InputError as place_lines().
double leaf_wanted_by_layers(const Geometry& geometry, const std::vector<LayerLine>& lines);

/// The front of all boundaries that ask for layers, and of lines with layers. Layers are thinner where walls
/// come close to each other or turn sharply into the domain, so that no two columns meet, and each wall keeps
/// room for cells outside; both are proved with exact signs. `curvature`: degrees that the wall may turn
/// along one cell. With a measured wall first heights follow it (followed_layers()). A function of its
/// arguments alone; mirror images have mirrored fronts. Throws InputError, naming the place, where no layers
/// fit. `geometry` must outlive the result.
LayerFront layer_front(const Geometry& geometry, std::optional<double> curvature = {},
                       const std::vector<LayerLine>& lines = {}, const MeasuredWall& measured = {});

/// The front's stations alone, with the layers that they ask for.
WallLine wall_line(const Geometry& geometry, const std::vector<LayerLine>& lines,
                   const MeasuredWall& measured);

}  // namespace quadloop
