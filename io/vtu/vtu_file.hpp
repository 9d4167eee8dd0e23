#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/loaded/loaded_mesh.hpp"
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

/// Reads one piece of a VTK XML unstructured grid on the calling rank alone: ASCII, base64 and raw, inline
/// and appended, plain and compressed by zlib. Nodes lie in a plane z = constant and keep their order. Cells
/// are triangles, quads, pixels, polygons of three or four nodes; lines belong to the boundary that the cell
/// data "boundary" tells, without it to "boundary"; vertices are passed over. Point data and cell data of
/// real numbers are the solution: an array of several components becomes name_x, name_y and, unless it is 0
/// all over, name_z. Cells and edges are put right as for other programs' meshes (foreign_mesh). Throws
/// InputError "file:line: ..." on anything that is not such a mesh.
LoadedMesh read_vtu(const std::string& path);

}  // namespace quadloop
