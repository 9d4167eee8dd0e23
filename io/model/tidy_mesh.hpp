#pragma once

#include <string>

#include "io/model/loaded_mesh.hpp"

namespace quadloop {

/// Mends in a mesh from a file what has one cure alone, so that it can be worked on; what was changed is
/// added to its warnings, with `path`: nodes that belong to no cell are left out, and their rows of the
/// solution; cells that run clockwise are turned (orient_cells), so that inverted ones stay for validate()
/// and untangling; boundary edges with their cell to the right are turned, boundaries without edges left out;
/// edges of one cell that no boundary names become a boundary of their own, "boundary" or the first of
/// "boundary_2" ... that is free, of condition none. `check` must not do this: it is there to report it. The
/// nodes that cells and edges name must exist. O(n log n).
void tidy_mesh(LoadedMesh& loaded, const std::string& path);

}  // namespace quadloop
