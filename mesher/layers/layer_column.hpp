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

}  // namespace quadloop
