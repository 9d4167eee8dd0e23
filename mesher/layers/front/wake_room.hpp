#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/layers/front/layer_lines.hpp"
#include "mesher/layers/front/wall_line.hpp"

namespace quadloop {

/// Distance from a point on a line that is free of everything that its layers must keep clear of.
using FreeDistance = std::function<double(Point)>;

/// Parts of the free distance that a wake's layers on one side, with the rows behind a base, and the width of
/// its columns may have at most. The triangles beside the layers are less high than columns are wide: more
/// than a third is left to the cells outside.
constexpr double layers_over_room = 0.4, width_over_room = 0.25;

/// The height of half the rows behind a base in narrow places, over that of the layers on one side.
constexpr double core_over_layers = 0.5;
/// The thickness of the layers on one side that this free distance allows a wake behind a base with this half
/// length, 0 at a sharp edge.
double layers_in_room(double free, double half_base);

/// The room for the wakes that follow the flow: they keep clear of other walls with their layers, of other
/// boundaries and of other lines.
class WakeRoom {
 public:
  /// Beside layers whose `fronts` are known: the outer ends of the columns, one for each station of `walls`.
  /// All must outlive the object.
  WakeRoom(const WallLine& walls, std::span<const Point> fronts, const std::vector<PlacedLine>& lines);
  /// Before layers have been fitted: walls get the share of the distance from a wake that they get of a gap.
  WakeRoom(const WallLine& walls, const std::vector<PlacedLine>& lines);

  /// Infinity for a wake that does not follow the flow.
  double free(const PlacedLine& wake, Point p) const { return nearest(wake, p).distance; }
  FreeDistance around(const PlacedLine& wake) const;

  /// `wake`, or its part before the first place with room for less than a third of the layers at its root.
  /// Never shorter than twice their thickness.
  PlacedLine with_room(const PlacedLine& wake) const;

  /// The largest thickness of the layers at each station of the walls that leaves the wakes their room; empty
  /// without wakes that follow the flow.
  std::vector<double> thickness_of_walls() const;

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
  /// The largest thickness at the root from which the wake can become as thin as its room requires.
  double thickness_at_root(const PlacedLine& wake) const;
  std::string name_of(const Nearest& nearest) const;

  const WallLine& walls_;
  const Geometry& geometry_;
  double share_;  ///< of the distance from an obstacle that is free
  const std::vector<PlacedLine>& lines_;
  std::vector<Obstacle> obstacles_;
  BoxTree tree_;
};

}  // namespace quadloop
