#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// A part of the boundary between two feature points.
struct ShortBase {
  std::int32_t first = 0, last = 0;  ///< vertices at its ends
};

/// Returns the place of the vertex to which both ends of a base are merged: the end where another boundary
/// begins, which keeps its direction, or the midpoint if this is true of both ends or of neither.
Point merged_end(const Geometry& geometry, ShortBase base);

/// Returns the geometry with the vertices of each base replaced by one at merged_end().
Geometry with_merged(const Geometry& geometry, std::span<const ShortBase> bases);

/// Returns the geometry with each base merged to one vertex at merged_end(); empty if no base was
/// merged. A base is one or more consecutive edges between feature points of one boundary, shorter than `min`
/// in total: e.g. a blunt trailing edge or a tiny notch, which would get thin triangles. This is repeated
/// until no such edge is left, except those that stay: an edge in a row of more than four feature points less
/// than 4 `min` apart, e.g. along a coast, of which the mesh loses some anyway; an edge with layers, as it
/// has columns, and leaves only at their outer edge; all of a boundary; an edge of an interface or of a loop
/// smaller than `min` in both directions; an edge without which the boundary would touch itself. One warning
/// gives the number of merged edges and the location of the longest, another one those of the edges that
/// cannot be merged.
std::optional<Geometry> short_edges_merged(const Geometry& geometry, double min,
                                           std::vector<std::string>& warnings);

}  // namespace quadloop
