#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::smoother {

/// Checks that a geometry from the file `path` belongs to a mesh that is whole on this rank. Throws
/// InputError if no mesh boundary has its name in the geometry or if a boundary node is farther from its
/// boundary than a tenth of an adjacent edge (the message gives name and coordinates). Returns warnings:
/// boundaries that the geometry lacks, nodes that are too far from it to slide.
std::vector<std::string> require_match(const Geometry& outline, const Mesh& whole, const std::string& path);

/// A flag for each loop of the geometry along which most mesh boundary edges have the opposite direction. The
/// mesh defines the side of the domain; a geometry alone (an airfoil without far field) does not.
std::vector<char> loops_against(const Geometry& outline, const Mesh& whole);

/// The geometry with the flagged loops reversed.
Geometry with_loops_turned(const Geometry& outline, const std::vector<char>& turned);

}  // namespace quadloop::smoother
