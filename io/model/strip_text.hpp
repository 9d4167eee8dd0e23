#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Returns a strip as comments of a .mesh file: `# strip NAME COUNT THICKNESS ACROSS COLUMNS wake`, or `line`
/// if it does not begin at a wall, then `# nodes 7-67 5 4` etc.: the nodes of its columns, from 1; runs of
/// consecutive numbers, ascending or descending, are given by their ends.
std::string comments_of(const StripLayers& strip);

struct StripsInText {
  std::vector<StripLayers> strips;
  std::vector<std::string> damaged;  ///< names of invalid strips
};

/// Reads strips from a text that consists of comments.
StripsInText strips_in_comments(std::string_view comments, std::int32_t nodes_of_mesh);

/// Whether a strip's numbers are consistent and its nodes are distinct and exist in a mesh of this size.
bool is_sound(const StripLayers& strip, std::int64_t nodes_of_mesh);

}  // namespace quadloop::io
