#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// The comment before the edges of an inner line: "# inner line NAME EDGES". Each edge follows as a comment
/// with its two nodes, from 1: "# 3 4".
std::string line_comment(const std::string& name, std::int64_t edges);

/// The inner lines in the comments of a native mesh file. A line with fewer edges than announced, or with a
/// node beyond the mesh, is left out.
std::vector<BoundaryEdges> lines_in_comments(std::string_view comments, std::int32_t nodes_of_mesh);

}  // namespace quadloop::io
