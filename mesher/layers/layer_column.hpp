#pragma once

#include <vector>

#include "mesher/layers/front_places.hpp"

namespace quadloop {

/// The nodes of a column between the wall and a node of the front, from the wall on and without the node
/// itself: as many as there are layers. `first` is the height asked for at the wall, normal to it.
std::vector<Point> layer_column(const LayerFront& front, const FrontPlace& place, Point node);

}  // namespace quadloop
