#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/loaded_solution.hpp"

namespace quadloop {

/// Reads a table of values at nodes as SU2 leaves its restart file: a first line of names in double quotes or
/// without, then one line a node, in the order of the mesh; a column "PointID", from 0, sorts the lines. The
/// columns x, y (and z, which must be constant) are coordinates, all others variables. Throws InputError
/// "file:line: ...".
LoadedSolution read_su2_csv(const std::string& path);

/// Writes a solution as SU2 reads its restart file: "PointID", "x", "y", then SU2's conservative variables
/// "Density", "Momentum_x", "Momentum_y" and "Energy" (a volume's), non-dimensional as the solution is, then
/// all other variables under their names. A solution that has the four keeps their bits; from density,
/// velocity and pressure they are computed with `gamma`, the ratio of specific heats, in the place of those;
/// one with neither keeps its variables. Numbers are the shortest that read back as they are; the same bytes
/// on any number of ranks. *Collective.* Throws OutputError on all ranks.
void write_su2_csv(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field& solution,
                   double gamma = 1.4);

}  // namespace quadloop
