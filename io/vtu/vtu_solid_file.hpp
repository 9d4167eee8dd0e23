#pragma once

#include <optional>
#include <string>

#include "io/files/output_file.hpp"
#include "io/solid/solid_stream.hpp"
#include "mesher/solid/solid_mesh.hpp"

namespace quadloop {

/// Writes the mesh as a VTK XML unstructured grid, raw appended, the bytes the same on any number of ranks:
/// wedges, hexahedra, then the faces of patches as triangles and quads. The cell data "boundary" and the
/// field data "boundary_names" are as in write_vtu(). VTK has the first triangle of a wedge look outwards, so
/// that the two last nodes of each of its triangles change places. The solution becomes point data and
/// cell data; a face has the values of the cell beside it. Of several blocks the cell data "block" is a
/// cell's, from 1, 0 on faces, and the field data "block_names" tell the names.
/// *Collective.* Throws OutputError on all ranks.
void write_vtu_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path);

/// Reads one piece of a VTK XML unstructured grid of tetrahedra, pyramids, wedges, hexahedra and voxels, on
/// the calling rank alone; nothing where it holds none of these. Triangles and quads belong to the patch that
/// the cell data "boundary" tells, without it to "boundary"; points and lines are passed over. Throws
/// InputError.
std::optional<SolidMesh> read_vtu_solid(const std::string& path);

}  // namespace quadloop
