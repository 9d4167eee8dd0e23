#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Returns the geometry with the two ends of each short base merged to one vertex at its midpoint; empty if
/// no base was merged. A short base is a part of the boundary, of one or more segments, between feature
/// points that is shorter than `min`, with no other feature point within 4 `min` along the boundary: e.g. a
/// blunt trailing edge, which would get one thin triangle. A base with layers does not count, as it has
/// columns, and leaves only at their outer edge. A base is kept if it is all of its boundary, if it belongs
/// to an interface, if its loop is smaller than `min` in both directions, or if the boundary would touch
/// itself. One warning gives the number of merged edges and the location of the longest, another one those of
/// the bases that are kept.
std::optional<Geometry> short_edges_merged(const Geometry& geometry, double min,
                                           std::vector<std::string>& warnings);

}  // namespace quadloop
