#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/layers/front/layer_lines.hpp"
#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

/// Distance from a point on a line to the nearest thing that its layers must keep clear of.
using FreeDistance = std::function<double(Point)>;

/// Parts of the free distance that a wake's layers on one side, with the rows behind a base, and the width of
/// its columns may have at most. The triangles beside the layers are less high than columns are wide: more
/// than a third is left to the cells outside.
constexpr double layers_over_room = 0.4, width_over_room = 0.25;

/// The room for the wakes that follow the flow: they keep clear of other walls with their layers, of other
/// boundaries and of other lines.
class WakeRoom {
 public:
  /// `fronts`: the outer ends of the columns, one for each station of `walls`. All must outlive the object.
  WakeRoom(const WallLine& walls, std::span<const Point> fronts, const std::vector<PlacedLine>& lines);

  /// Infinity for a wake that does not follow the flow.
  double free(const PlacedLine& wake, Point p) const { return nearest(wake, p).distance; }
  FreeDistance around(const PlacedLine& wake) const;

  /// `wake`, or its part before the first place with room for less than a third of its layers. Never shorter
  /// than twice the thickness of its layers.
  PlacedLine with_room(const PlacedLine& wake) const;

 private:
  struct Obstacle {
    Point from, to;
    BoundaryId boundary;
  };
  struct Nearest {
    double distance;
    std::int32_t obstacle = BoxTree::none;
    const PlacedLine* line = nullptr;
  };
  Nearest nearest(const PlacedLine& wake, Point p) const;
  std::string name_of(const Nearest& nearest) const;

  const Geometry& geometry_;
  const std::vector<PlacedLine>& lines_;
  std::vector<Obstacle> obstacles_;
  BoxTree tree_;
};

}  // namespace quadloop
