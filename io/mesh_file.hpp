#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/extruded_mesh.hpp"
#include "io/model/mesh_of_file.hpp"

namespace quadloop::io {

/// Reads a mesh in the format (formats.hpp) of the file's suffix, or a complete set of partitions from its
/// index (.parts). A plane mesh is distributed, in the order of the file; a 3D mesh is whole on the root.
/// Throws InputError on all ranks. *Collective.*
MeshOfFile read_mesh_file(const Communicator& comm, const std::string& path);

/// Returns the plane mesh, distributed, also from a 3D mesh that is one cell thick. Throws InputError on all
/// ranks, with `path`, for any other 3D mesh. *Collective.*
LoadedMesh plane_of(const Communicator& comm, MeshOfFile mesh, const std::string& path);

/// read_mesh_file() of a plane mesh (plane_of()). *Collective.*
LoadedMesh read_mesh(const Communicator& comm, const std::string& path);

/// The same on the calling rank only: whole.
MeshOfFile read_mesh_file(const std::string& path);
LoadedMesh read_mesh(const std::string& path);

/// Throw InputError unless the suffix is that of a format that can be read, or written.
void require_readable_suffix(const std::string& path);
void require_writable_suffix(const std::string& path);

/// Writes a mesh from a file, with its solution and blocks if the format supports them. The format must
/// support meshes; if none is named it is that of the suffix. Throws OutputError on all ranks. *Collective.*
void write_mesh(OutputSet& outputs, const LoadedMesh& mesh, const std::string& path,
                const std::string& format = {});

/// The same as the only file of a set. *Collective.*
void write_mesh_file(const Communicator& comm, const LoadedMesh& mesh, const std::string& path,
                     const std::string& format = {});

/// Writes a distributed mesh in the format of the suffix, which must be valid, with a solution if the format
/// supports one. A file with the solution alone (.csv; write_su2_csv() needs `gamma`) is not written without
/// one. Throws OutputError on all ranks. *Collective.*
void write_mesh(OutputSet& outputs, const Mesh& mesh, const std::string& path,
                const Field* solution = nullptr, double gamma = 1.4);

/// Throws InputError unless the suffix is that of a format for writing 3D meshes.
void require_mesh3d_suffix(const std::string& path);

/// Write a 3D mesh, extruded, or whole on the set's only rank, in the named format, or else that of the
/// suffix, which must support 3D meshes. *Collective.*
void write_mesh(OutputSet& outputs, const ExtrudedMesh& mesh, const std::string& path,
                const std::string& format = {});
void write_mesh(OutputSet& outputs, const FileMesh& mesh, const std::string& path,
                const std::string& format = {});

/// Removes the boundaries between blocks from a plane mesh with several blocks: in 3D they are inside the
/// mesh. If the format has a zone for each block, they are completed instead. Returns a line for each loss,
/// with the output's name. *Collective.*
std::vector<std::string> drop_interfaces(const Communicator& comm, LoadedMesh& mesh, const std::string& path);

/// Returns a line that counts the boundaries whose names the format, or else that of the suffix, cannot
/// store, with the new name of the first, and a line on those whose conditions become others there; empty if
/// all are kept.
std::vector<std::string> changes_in(const Mesh& mesh, const std::string& path,
                                    const std::string& format = {});

/// Returns the data of the mesh that the format, or else that of the suffix, does not support: one line each,
/// with the file's name, including renames. For a distributed mesh the result is the same on every rank, and
/// the one for a mesh from a file is *collective*; `solution` may be null.
std::vector<std::string> losses_in(const Communicator& comm, const LoadedMesh& mesh, const std::string& path,
                                   const std::string& format = {});
std::vector<std::string> losses_in(const FileMesh& mesh, const std::string& path,
                                   const std::string& format = {});
std::vector<std::string> losses_in(const ExtrudedMesh& mesh, const std::string& path);
std::vector<std::string> losses_in(const Mesh& mesh, const Field* solution, const std::string& path);

}  // namespace quadloop::io
