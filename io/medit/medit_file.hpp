#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Whether a regular file is in Medit's text format: it begins with MeshVersionFormatted.
bool is_medit(const std::string& path);

/// Reads a plane mesh in Medit's text format on the calling rank only: 2D vertices, or 3D ones in a plane z =
/// constant, triangles, quadrilaterals and edges, each with a reference. That of an edge becomes the boundary
/// "boundary_<reference>", that of a cell the block "block_<reference>", or "domain" if all are equal. Other
/// sections are skipped. Throws InputError "file:line: ..." on anything else; geometric errors are left to
/// validate(). P. Frey, MEDIT, INRIA RT-0253 (2001), section 3.
MeshOfFile read_medit(const std::string& path);

/// Writes such a file: references of boundaries are those of medit_boundary_names(), those of cells the block
/// numbers, from 1. Throws OutputError on all ranks. *Collective.*
void write_medit(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Returns the names as they are read back: "boundary_<reference>" is unchanged, the others get the first
/// free references, from 1.
std::vector<std::string> medit_boundary_names(const std::vector<std::string>& names);

}  // namespace quadloop::io
