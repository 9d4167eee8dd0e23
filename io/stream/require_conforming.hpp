#pragma once

#include <cstdint>
#include <string>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Throws OutputError, for a format of faces, unless each edge of a cell is that of another cell or on one
/// boundary; `between` is how many boundary edges of this rank have cells on both sides. *Collective.*
void require_conforming(const Communicator& comm, const Mesh& mesh, const EdgeCells& cells,
                        std::int64_t between, const std::string& path);

}  // namespace quadloop
