#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Returns a pair as a comment of a .mesh file: `# pair FROM TO translation DX DY`, or `# pair FROM TO
/// rotation DEGREES X Y` with the centre, as the shortest numbers that read back to the same doubles.
std::string comment_of(const PeriodicPair& pair);

/// Reads the pairs from a text that consists of comments; lines that are no pair are passed over.
std::vector<PeriodicPair> pairs_in_comments(std::string_view comments);

/// Returns the strips, the pairs and the named nodes of a mesh as comments.
std::string comments_of(const Mesh& mesh);

}  // namespace quadloop::io
