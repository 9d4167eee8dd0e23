#pragma once

#include <optional>
#include <string>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Returns a warning of the ends of inner lines that are so near to another boundary, or to another part of
/// the line, that the triangles between are thin: nearer than a tenth of the edge of the mesh at the end. It
/// gives the nearest one of them, its distance and the remedies; none if there are none. `mesh` must be
/// unsmoothed. *Collective.*
std::optional<std::string> warning_of_near_ends(const Communicator& comm, const Geometry& geometry,
                                                const Mesh& mesh);

}  // namespace quadloop
