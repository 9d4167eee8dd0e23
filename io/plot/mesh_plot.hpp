#pragma once

#include <string>

#include "io/model/loaded_mesh.hpp"
#include "io/plot/plot_options.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::io {

/// Returns the picture of a distributed mesh as a file's bytes on the root, none elsewhere. The root gets the
/// cells in the window one after another, and the boundary edges. Bitwise independent of the number of ranks.
/// Cells and edges too small to be distinguished are shaded. Throws InputError on all ranks, "what is wrong;
/// what to do" without a file's name, for an empty window, one without cells, or a field that does not exist.
/// *Collective.*
std::string draw_mesh(const Communicator& comm, const LoadedMesh& loaded, const PlotOptions& options,
                      PlotFormat format);

}  // namespace quadloop::io
