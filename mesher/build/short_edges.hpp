#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// The geometry in which the two ends of each short base become one vertex, in its middle; none where no base
/// was merged. A short base is a stretch of the outline, of one segment or several, between kept corners that
/// is shorter than `min`, with no other corner within 4 `min` along the outline: a blunt trailing edge, on
/// which one thin triangle would stand. A base with layers is none, as columns stand on it and leaves only on
/// their front. A base stays
/// where it is all that there is of its boundary, where it belongs to an interface, where its loop is smaller
/// than `min` both ways, and where the outline would touch itself. One warning gives the count of merged
/// edges and the place of the longest, another one those of the bases that stay.
std::optional<Geometry> short_edges_merged(const Geometry& geometry, double min,
                                           std::vector<std::string>& warnings);

}  // namespace quadloop
