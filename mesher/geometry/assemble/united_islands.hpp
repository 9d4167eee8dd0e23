#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/outline.hpp"

namespace quadloop {

/// Islands that overlap or share edges become one: the union of what they enclose. Of islands that meet the
/// outer boundary the part inside it is taken out of the domain. An island inside another one is dropped; a
/// ring inside a polygon of its own feature, or a loop that its file directs so, stays a hole in the island,
/// with domain in it. Loops that meet no other stay as they are. Each edge keeps the boundary of the loop
/// that it comes from; of loops that share it, the first. Points nearer than the share `join` of the extent
/// count as one, points nearer to a segment as on it. Warnings count what was joined and dropped. Throws
/// InputError, naming boundary and coordinates, where a loop crosses itself.
Outline united_islands(const Outline& outline, double join, std::vector<std::string>& warnings);

}  // namespace quadloop
