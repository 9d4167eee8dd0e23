#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Writes a mesh as a VTKHDF unstructured grid of version 1.0 (VTK 9.1, ParaView 5.11), in one piece, into
/// the set; the bytes are the same on any number of ranks. The arrays are those of write_vtu(), but variables
/// have the names of vtkhdf_variable_names(), names of boundaries and blocks and the descriptions of a plane
/// mesh are texts, and boundaries have no field data of their own. Throws OutputError on all ranks.
/// *Collective.*
void write_vtkhdf(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Returns the names of variables in the file, distinct from each other and from the arrays of the mesh: in
/// HDF5 a "/" separates groups, and becomes "_".
std::vector<std::string> vtkhdf_variable_names(const std::vector<std::string>& names);

}  // namespace quadloop::io
