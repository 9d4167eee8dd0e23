#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Whether a regular file is Medit's text: it begins with MeshVersionFormatted.
bool is_medit(const std::string& path);

/// Reads a plane mesh of Medit's text on the calling rank alone: vertices of two dimensions, or of three in a
/// plane z = constant, triangles, quadrilaterals and edges, each with a reference. An edge's becomes the
/// boundary "boundary_<reference>", a cell's the block "block_<reference>", or "domain" where all have the
/// same. Other sections are passed over. Throws InputError "file:line: ..." on anything that is not such a
/// mesh; geometric faults are left to validate(). P. Frey, MEDIT, INRIA RT-0253 (2001), section 3.
MeshOfFile read_medit(const std::string& path);

/// Writes such a file: references of boundaries are those of medit_boundary_names(), cells have that of their
/// block, from 1. *Collective.* Throws OutputError on all ranks.
void write_medit(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// The names as they are read back: "boundary_<reference>" stays, the others get the first references that
/// are free, from 1.
std::vector<std::string> medit_boundary_names(const std::vector<std::string>& names);

}  // namespace quadloop
