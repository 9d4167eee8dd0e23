#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Asks whether an outline from the file `path` belongs to a mesh that is whole on this rank. Throws
/// InputError where none of the mesh's boundaries has its name in the outline, and, with name and
/// coordinates, where a boundary node lies farther from the boundary of its name than a tenth of an edge
/// there. Returns warnings: boundaries that the outline lacks, nodes that lie too far off it to slide.
std::vector<std::string> require_match(const Geometry& outline, const Mesh& whole, const std::string& path);

/// A flag for each loop of the outline: most of the mesh's boundary edges on it run the other way. The mesh
/// knows on which side the domain lies; an outline alone, as that of an airfoil without its far field, does
/// not.
std::vector<char> loops_against(const Geometry& outline, const Mesh& whole);

/// The outline with the flagged loops walked the other way.
Geometry with_loops_turned(const Geometry& outline, const std::vector<char>& turned);

}  // namespace quadloop
