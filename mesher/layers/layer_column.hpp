#pragma once

#include <vector>

#include "mesher/layers/front_places.hpp"

namespace quadloop {

/// A column between the wall and a node of the front.
struct LayerColumn {
  Point foot;         ///< on the wall
  double cosine = 1;  ///< of its angle to the wall's normal
  ColumnHeights heights;
};
LayerColumn column_at(const LayerFront& front, const FrontPlace& place, Point node);

/// The nodes of a column, from the wall outwards, without the front node itself: as many as there are layers.
std::vector<Point> layer_column(const LayerFront& front, const FrontPlace& place, Point node);

/// The point of the front at a place.
Point point_of_front(const LayerFront& front, const FrontPlace& place);

/// The nodes of a column that stands on a given node of the wall and rises to the front at the same place, as
/// layer_column(); the first one is `foot`.
std::vector<Point> column_on_foot(const LayerFront& front, const FrontPlace& place, Point foot);

}  // namespace quadloop
