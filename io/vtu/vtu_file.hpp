#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/solid/solid_stream.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Writes the mesh as a VTK XML unstructured grid, raw appended, into the set; the bytes are the same on any
/// number of ranks. Triangles, then quads, then the boundaries' edges as lines. The cell data "boundary"
/// holds 0 for cells and the boundary's number, from 1, for lines; the field data "boundary_names" the names,
/// as codes of their bytes with a 0 after each. `solution`, where given, becomes point data and cell data of
/// its names; a line has the values of the cell beside it. *Collective.* Throws OutputError on all ranks.
void write_vtu(OutputSet& outputs, const Mesh& mesh, const std::string& path,
               const Field* solution = nullptr);

/// The same as an output of its own, in place when the function returns. *Collective.*
void write_vtu(const Communicator& comm, const Mesh& mesh, const std::string& path,
               const Field* solution = nullptr);

/// Writes a mesh that the set's only rank holds whole, with its solution; blocks (has_named_blocks()) are
/// told by the cell data "block". Throws OutputError.
void write_vtu(OutputSet& outputs, const LoadedMesh& whole, const std::string& path);

/// Writes a 3D mesh as a VTK XML unstructured grid, raw appended, the bytes the same on any number of ranks:
/// cells by kind, then the faces of patches as triangles and quads. The cell data "boundary" and the field
/// data "boundary_names" are as in write_vtu(). VTK has the first triangle of a wedge look outwards, so that
/// the two last nodes of each of its triangles change places. The solution becomes point data and cell data;
/// a face has the values of the cell beside it. Where there are several blocks, the cell data "block" are a
/// cell's block, from 1, 0 on faces, and the field data "block_names" their names. *Collective.* Throws
/// OutputError on all ranks.
void write_vtu_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path);

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
