#pragma once

#include <vector>

#include "mesher/layers/front_places.hpp"

namespace quadloop {

/// A column as it stands between the wall and a node of the front.
struct LayerColumn {
  Point foot;         ///< on the wall
  double cosine = 1;  ///< of its tilt against the wall's normal
  ColumnHeights heights;
};
LayerColumn column_at(const LayerFront& front, const FrontPlace& place, Point node);

/// The nodes of a column between the wall and a node of the front, from the wall on and without the node
/// itself: as many as there are layers. `first` is the height asked for at the wall, normal to it.
std::vector<Point> layer_column(const LayerFront& front, const FrontPlace& place, Point node);

}  // namespace quadloop
