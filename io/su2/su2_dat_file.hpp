#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/loaded_solution.hpp"

namespace quadloop {

/// Reads SU2's binary restart file (SU2, CSU2BinaryFileWriter): five 32-bit integers (535532, the numbers of
/// variables and of nodes, two not used), the variables' names in 33 bytes each, then a row of doubles for
/// each node in the order of the mesh, all in the order of bytes of the machine that wrote it; SU2 before
/// version 7 has a few numbers more behind them, which are passed over. The variables x and y are
/// coordinates. Throws InputError "file: ...".
LoadedSolution read_su2_dat(const std::string& path);

/// Writes a solution as SU2 reads its binary restart file: x, y and the columns of Su2RestartTable; names
/// longer than 32 bytes are cut. The same bytes on any number of ranks. *Collective.* Throws OutputError on
/// all ranks.
void write_su2_dat(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field& solution,
                   double gamma = 1.4);

}  // namespace quadloop
