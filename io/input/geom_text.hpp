#pragma once

#include <span>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop::io {

/// Reads a `.geom` file. Throws InputError "file:line: ..." if it is invalid.
std::vector<Chain> read_geom(const std::string& path);

/// Returns the chains as the text of a `.geom` file that reads back to the same coordinates and curves.
std::string geom_text(std::span<const Chain> chains);

/// Returns the geometry as the text of a `.geom` file that reads back to the same coordinates: a loop of one
/// boundary is written unchanged, a loop of several as one open chain for each run of segments of one
/// boundary.
std::string geom_text(const Geometry& geometry);

}  // namespace quadloop::io
