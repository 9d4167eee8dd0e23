#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Returns a named node as a comment of a .mesh file: `# node NUMBER NAME`, numbered from 1.
std::string comment_of(const NamedNode& node);

/// Reads the named nodes from a text that consists of comments; other lines, and nodes beyond the mesh, are
/// passed over.
std::vector<NamedNode> nodes_in_comments(std::string_view comments, std::int32_t nodes_of_mesh);

}  // namespace quadloop::io
