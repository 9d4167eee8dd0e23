#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/loaded_solution.hpp"

namespace quadloop::io {

/// Reads SU2's binary restart file (SU2, CSU2BinaryFileWriter): five 32-bit integers (535532, the numbers of
/// variables and of nodes, two unused), the variables' names in 33 bytes each, then a row of doubles for each
/// node in the order of the mesh, all in the byte order of the machine that wrote it; further numbers of SU2
/// before version 7 are skipped. The variables x and y are coordinates. Each rank reads its even share of the
/// rows. Throws InputError "file: ..." on all ranks. *Collective.*
LoadedSolution read_su2_dat(const Communicator& comm, const std::string& path);

/// Writes a solution as a binary restart file for SU2: x, y and the columns of Su2RestartTable; names longer
/// than 32 bytes are truncated. The bytes are the same on any number of ranks. Throws OutputError on all
/// ranks. *Collective.*
void write_su2_dat(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field& solution,
                   double gamma = 1.4);

}  // namespace quadloop::io
