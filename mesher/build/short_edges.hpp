#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// The geometry in which the two ends of each edge between kept corners that is shorter than `min` become one
/// vertex, in the middle of the edge; none where no edge was merged. An edge stays where it is all that there
/// is of its boundary, where it belongs to an interface, where its loop is smaller than `min` both ways,
/// where one of the next two edges on either side is short too, and where the outline would touch itself. One
/// warning gives the count of merged edges and the place of the longest, another one those of the edges that
/// stay.
std::optional<Geometry> short_edges_merged(const Geometry& geometry, double min,
                                           std::vector<std::string>& warnings);

}  // namespace quadloop
