#pragma once

#include <string>

#include "io/model/loaded_mesh.hpp"

namespace quadloop::io {

/// Repairs errors of a mesh from a file that have a unique remedy. Each change is added to its warnings, with
/// `path`: nodes without cells are removed, with their rows of the solution; clockwise cells are reversed
/// (orient_cells), so that inverted ones are left to validate() and untangling; boundary edges with their
/// cell on the right are reversed, boundaries without edges removed; edges inside a block become inner
/// curves; edges of one cell without a boundary form a new boundary, "boundary" or the first free one of
/// "boundary_2" ..., with condition none. Not used by `check`, which reports these errors. The nodes of cells
/// and edges must exist. O(n log n).
void tidy_mesh(LoadedMesh& loaded, const std::string& path);

}  // namespace quadloop::io
