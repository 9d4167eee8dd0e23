#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// Returns the geometry with each base merged to one vertex at the midpoint of its ends; empty if no base was
/// merged. A base is one or more consecutive edges between feature points of one boundary, shorter than `min`
/// in total: e.g. a blunt trailing edge or a tiny notch, which would get thin triangles. This is repeated
/// until no edge between feature points is shorter than `min`, except those that stay: an edge with layers,
/// as it has columns, and leaves only at their outer edge; all of a boundary; an edge of an interface or of a
/// loop smaller than `min` in both directions; an edge without which the boundary would touch itself. One
/// warning gives the number of merged edges and the location of the longest, another one those of the edges
/// that stay without layers.
std::optional<Geometry> short_edges_merged(const Geometry& geometry, double min,
                                           std::vector<std::string>& warnings);

}  // namespace quadloop
