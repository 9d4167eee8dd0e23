#pragma once

#include <optional>
#include <string>

#include "io/loaded/loaded_mesh.hpp"
#include "io/plot/plot_canvas.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

enum class PlotColouring { type, block, quality };

/// What a picture of a mesh shows.
struct PlotOptions {
  PlotColouring colouring = PlotColouring::type;
  std::string field;          ///< a variable of the solution, instead of `colouring`; empty for none
  std::optional<Box> window;  ///< the whole mesh where absent
  double size = 1600;         ///< pixels along the longer side, margins included; at least 400
};

/// The picture of a mesh, as a file's bytes. Cells and edges too small to be told apart become an even shade.
/// Throws InputError, "what is wrong; what to do" without a file's name: an empty window, one that shows no
/// cell, a field that is not there.
std::string draw_mesh(const LoadedMesh& loaded, const PlotOptions& options, PlotFormat format);

}  // namespace quadloop
