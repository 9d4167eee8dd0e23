#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A strip as comments of a .mesh file tell of it: `# strip NAME COUNT THICKNESS ACROSS COLUMNS wake`, or
/// `line` where it does not begin at a wall, then `# nodes 7-67 5 4` and so on: the nodes of its columns from
/// 1 on, runs of numbers that follow each other upwards or downwards by their ends.
std::string comments_of(const StripLayers& strip);

struct StripsInText {
  std::vector<StripLayers> strips;
  std::vector<std::string> damaged;  ///< names of those that are no strips of this mesh
};

/// The way back, from a text of comments alone.
StripsInText strips_in_comments(std::string_view comments, std::int32_t nodes_of_mesh);

/// Whether a strip's numbers fit each other and a mesh of so many nodes, each of which a strip has once.
bool is_sound(const StripLayers& strip, std::int64_t nodes_of_mesh);

}  // namespace quadloop
