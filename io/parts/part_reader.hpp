#pragma once

#include <string>

#include "io/model/loaded_mesh.hpp"

namespace quadloop::io {

/// Returns the whole mesh of PREFIX.parts and its files, as before partitioning: nodes, cells and boundary
/// edges in their order, coordinates and values bitwise. On the calling rank only. Throws InputError.
LoadedMesh read_parts(const std::string& path);

}  // namespace quadloop::io
