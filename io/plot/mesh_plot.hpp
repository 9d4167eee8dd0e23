#pragma once

#include <string>

#include "io/model/loaded_mesh.hpp"
#include "io/plot/plot_options.hpp"

namespace quadloop::io {

/// Returns the picture of a mesh as a file's bytes. Cells and edges too small to be distinguished are shaded.
/// Throws InputError, "what is wrong; what to do" without a file's name, for an empty window, one without
/// cells, or a field that does not exist.
std::string draw_mesh(const LoadedMesh& loaded, const PlotOptions& options, PlotFormat format);

}  // namespace quadloop::io
