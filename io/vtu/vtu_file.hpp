#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Writes a mesh as a VTK XML unstructured grid, raw appended, into the set; the bytes are the same on any
/// number of ranks. Cells by kind, then boundary after boundary its edges as lines, or in a 3D mesh its faces
/// as triangles and quads. The cell data "boundary" hold 0 for cells and the boundary's number, from 1, for
/// its elements; the field data "boundary_names" hold the names, as codes of their bytes with a 0 after each.
/// VTK has the first triangle of a wedge look outwards, so that the two last nodes of each of its triangles
/// change places. The solution becomes point data and cell data of its names; an element of a boundary has
/// the values of the cell beside it. Where blocks have names, the cell data "block" are a cell's block, from
/// 1, and 0 at boundaries, and the field data "block_names" the names. *Collective.* Throws OutputError on
/// all ranks.
void write_vtu(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Reads one piece of a VTK XML unstructured grid on the calling rank alone: ASCII, base64 and raw, inline
/// and appended, plain and compressed by zlib. Nodes keep their order. A grid with cells of three dimensions
/// (tetrahedra, pyramids, wedges, hexahedra, voxels) is a 3D mesh, and its triangles and quads are boundary
/// faces; else its nodes lie in a plane z = constant, its cells are triangles, quads, pixels, polygons of
/// three or four nodes, and lines are boundary edges. Those of the boundary belong to the one that the cell
/// data "boundary" tells, without it to "boundary"; other elements are passed over. Point data and cell data
/// of real numbers are the solution: an array of several components becomes name_x, name_y and name_z, in a
/// plane mesh without name_z where that is 0 everywhere. A plane mesh is cleaned up by plane_mesh(). Throws
/// InputError "file:line: ..." on anything that is not such a mesh.
MeshOfFile read_vtu(const std::string& path);

}  // namespace quadloop
