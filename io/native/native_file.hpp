#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/loaded_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Writes the mesh as native text into the set; the bytes are the same on any number of ranks. A boundary
/// without edges on any rank is left out. `solution`, where given, has a row for each owned node.
/// *Collective.* Throws OutputError on all ranks.
void write_native(OutputSet& outputs, const Mesh& mesh, const std::string& path,
                  const Field* solution = nullptr);

/// The same as an output of its own, in place when the function returns. *Collective.*
void write_native(const Communicator& comm, const Mesh& mesh, const std::string& path,
                  const Field* solution = nullptr);

/// Writes a mesh that the set's only rank holds whole, block by block, with its solution. Throws OutputError.
void write_native(OutputSet& outputs, const LoadedMesh& whole, const std::string& path);

/// Reads a native mesh, with the solution if the file has one, on the calling rank alone. Boundaries of the
/// same name become one. Throws InputError "file:line: ..." on anything that is not such a mesh; geometric
/// faults are left to validate().
LoadedMesh read_native(const std::string& path);

}  // namespace quadloop
