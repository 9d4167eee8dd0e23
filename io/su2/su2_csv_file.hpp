#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/loaded_solution.hpp"

namespace quadloop::io {

/// Reads a table of nodal values in the format of SU2's restart file: a first line of names, optionally in
/// double quotes, then one line per node, in the order of the mesh; a column "PointID", from 0, sorts the
/// lines. The columns x, y (and z, which must be constant) are coordinates, all others variables. Each rank
/// reads its range of lines; if the lines are not in the order of their PointIDs, the root has all of these.
/// Throws InputError "file:line: ..." of the first error on all ranks. *Collective.*
LoadedSolution read_su2_csv(const Communicator& comm, const std::string& path);

/// Writes a solution as a restart file for SU2: "PointID", "x", "y", then SU2's conservative variables
/// "Density", "Momentum_x", "Momentum_y" and "Energy" (per volume), non-dimensional as in the solution, then
/// all other variables under their names. If the solution has these four they are kept bitwise; else they are
/// computed from density, velocity and pressure, which they replace, with `gamma`, the ratio of specific
/// heats; if it has neither, its variables are written unchanged. Numbers are the shortest that read back
/// bitwise; the bytes are the same on any number of ranks. Throws OutputError on all ranks. *Collective.*
void write_su2_csv(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field& solution,
                   double gamma = 1.4);

}  // namespace quadloop::io
