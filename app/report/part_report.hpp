#pragma once

#include "app/report/figures.hpp"
#include "mesher/mesh/parts/mesh_part.hpp"

namespace quadloop {

/// How many parts, and how good they are for a solver.
void add_parts(Figures& figures, const PartFigures& parts);

}  // namespace quadloop
