#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Writes a mesh as a VTK XML unstructured grid, raw appended, into the set; the bytes are the same on any
/// number of ranks. Cells are ordered by kind, then boundary by boundary follow its edges as lines or, in a
/// 3D mesh, its faces as triangles and quads. The cell data "boundary" are 0 for cells and the boundary's
/// number, from 1, for its elements; the field data "boundary_names" are the names, as byte codes with a 0
/// after each. In VTK the normal of a wedge's first triangle points outwards, so the last two nodes of each
/// of its triangles are swapped. The solution becomes point data and cell data of its names; a boundary
/// element has the values of the adjacent cell. If blocks have names, the cell data "block" are a cell's
/// block, from 1, and 0 at boundaries, and the field data "block_names" the names. Throws OutputError on all
/// ranks. *Collective.*
void write_vtu(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Reads one piece of a VTK XML unstructured grid on the calling rank only: ASCII, base64 and raw, inline and
/// appended, uncompressed or zlib. Nodes keep their order. A grid with 3D cells (tetrahedra, pyramids,
/// wedges, hexahedra, voxels) is a 3D mesh, and its triangles and quads are boundary faces; else its nodes
/// must be in a plane z = constant, its cells are triangles, quads, pixels, polygons of three or four nodes,
/// and lines are boundary edges. Boundary elements belong to the boundary in the cell data "boundary", or
/// without these to "boundary"; other elements are ignored. Point data and cell data of real numbers are the
/// solution: an array of several components becomes name_x, name_y and name_z, in a plane mesh without name_z
/// if that is 0 everywhere. A plane mesh is cleaned up by plane_mesh(). Throws InputError "file:line: ..." on
/// anything else.
MeshOfFile read_vtu(const std::string& path);

}  // namespace quadloop::io
