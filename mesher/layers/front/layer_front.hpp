#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/measured_flow.hpp"
#include "mesher/geometry/periodic_pair.hpp"
#include "mesher/layers/front/columns_on_wall.hpp"
#include "mesher/layers/front/layer_strip.hpp"
#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

/// The layer front: the outer edge of the layers, with the columns between it and the wall.
struct LayerFront {
  WallLine line;
  std::vector<double> thickness;  ///< of the layers at each station, normal to the wall: as requested or less
  WallColumns columns;
  std::vector<Point> points;  ///< of the front, one for each station

  /// The boundary of the domain outside the layers: the front replaces the wall, under the wall's boundary
  /// names.
  Geometry outer;
  /// For each segment of `outer` the station at which it begins, or WallLine::none if it is not on a wall's
  /// front.
  std::vector<std::int32_t> station_of;
  /// Height of the last layer at each segment of `outer`, or 0.
  std::vector<double> last_heights;

  /// Layers on both sides of lines. If there are any, their fronts are the last boundary of `outer`.
  std::vector<LayerStrip> strips;
  bool has_strips() const { return !strips.empty(); }
  /// Whether columns stand on nodes of other blocks (WallLine::is_interface). Their fronts are the last
  /// boundary of `outer`. There are no strips then.
  bool on_interfaces = false;
  BoundaryId interface_boundary() const { return strip_boundary(); }
  BoundaryId strip_boundary() const { return BoundaryId{size32(outer.boundaries()) - 1}; }
  /// Whether a segment of `outer` is on the front of a wall or of a strip.
  bool is_front(std::int32_t segment) const {
    return station_of[segment] != WallLine::none ||
           (has_strips() && outer.boundary_of(segment) == strip_boundary());
  }

  /// Requires these stations to be nodes of the mesh outside.
  void keep(const std::vector<std::int32_t>& stations);
};

/// Largest size of leaves beside the front, in heights of the last layer.
constexpr double leaf_over_last_layer = 2;

/// Size of the smallest leaves that fit the last layers, on walls and beside lines, if all layers have their
/// requested thickness; infinity without layers. Throws InputError as place_lines() does.
double leaf_wanted_by_layers(const Geometry& geometry, const std::vector<LayerLine>& lines);

/// The layer front of all boundaries and lines with layers. Layers are thinner where walls are close to each
/// other or have sharp concave corners, so that no two columns cross and space for cells remains outside each
/// wall; both are verified with exact predicates. `curvature`: degrees that the wall may turn along one cell.
/// With a measured wall first heights follow it (followed_layers()). Where adaptation requests smaller cells,
/// `adapted`, the columns of lines are as wide as these cells. Depends on its arguments only; mirror
/// images have mirrored fronts, and if `mirrored`, a geometry that is its own mirror image has a front with
/// mirrored sizes. Layers that end on both sides of a periodic pair are equally thick there. Throws
/// InputError with coordinates where no layers fit. `geometry` must outlive the result. The ranks of
/// `sharing` have the same arguments, divide the work and get the same front; null: this rank is alone.
/// *Collective* on these ranks.
LayerFront layer_front(const Geometry& geometry, std::optional<double> curvature = {},
                       const std::vector<LayerLine>& lines = {}, const MeasuredFlow& measured = {},
                       bool mirrored = false, const std::vector<PeriodicPair>& pairs = {},
                       const AdaptedSize& adapted = {}, const Communicator* sharing = nullptr);

/// Only the front's stations, with their requested layers.
WallLine wall_line(const Geometry& geometry, const std::vector<LayerLine>& lines,
                   const MeasuredFlow& measured);

}  // namespace quadloop
