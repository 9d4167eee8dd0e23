#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/outline.hpp"

namespace quadloop {

/// What a message about islands that overlap advises.
inline constexpr const char* union_remedy =
    ", or set geometry.overlap = \"union\" to join islands that overlap";

/// Unites islands that overlap or share edges. If an island meets the outer boundary, its part inside is
/// removed from the domain. An island inside another one is dropped. A ring inside a polygon of the same
/// feature, or a loop with a direction specified by its file, remains a hole of the island that contains
/// domain. Loops that meet no other are unchanged. Each edge keeps the boundary of its loop; a shared edge
/// that of the first loop. Points nearer than `join` (fraction of the extent) are identified, and points
/// nearer to a segment lie on it. Warnings count joined and dropped islands. Throws InputError with boundary
/// and coordinates if a loop crosses itself.
Outline united_islands(const Outline& outline, double join, std::vector<std::string>& warnings);

}  // namespace quadloop
