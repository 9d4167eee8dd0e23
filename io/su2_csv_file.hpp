#pragma once

#include <string>

#include "io/solution_file.hpp"

namespace quadloop {

/// Reads a table of values at nodes as SU2 leaves its restart file: a first line of names in double quotes or without, then one line a node, in the
/// order of the mesh; a column "PointID", from 0, sorts the lines. The columns x, y (and z, which must be constant) are coordinates, all others
/// variables. Throws InputError "file:line: ...".
LoadedSolution read_su2_csv(const std::string& path);

}  // namespace quadloop
