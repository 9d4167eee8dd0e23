#pragma once

#include <string>

#include "io/model/loaded_mesh.hpp"

namespace quadloop {

/// The whole mesh that PREFIX.parts and the files that it names are the parts of, as it was divided: nodes,
/// cells and boundary edges in their order, coordinates and values to the bit. On the calling rank alone.
/// Throws InputError.
LoadedMesh read_parts(const std::string& path);

}  // namespace quadloop
