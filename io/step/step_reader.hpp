#pragma once

#include <string>
#include <vector>

#include "io/dxf/drawing_choice.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop::io {

/// Reads the curves of a STEP file (AP203, AP214 or AP242), with unchanged coordinates, as chains with lines,
/// arcs and rational Bézier curves: free curves and wires, and the boundary edges of planar faces. They must
/// be in one plane parallel to a coordinate plane; `unit.plane` names it. A chain is named by its curve, edge
/// or face, else by its layer, else by the file, or as the choice says. Only the chosen layers are read, or
/// else all that are visible. Warnings count skipped entities. `unit` receives the declared unit. Throws
/// InputError "file:line: TYPE #number: ...".
std::vector<Chain> read_step(const std::string& path, const DrawingChoice& choice,
                             std::vector<std::string>& warnings, FileUnit& unit);

}  // namespace quadloop::io
