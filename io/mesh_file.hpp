#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/extruded_mesh.hpp"
#include "io/model/mesh_of_file.hpp"

namespace quadloop {

/// Reads a mesh in the format (formats.hpp) that the file's suffix tells, or the whole of a set of parts
/// whose index (.parts) is named, on the calling rank alone. Throws InputError.
MeshOfFile read_mesh_file(const std::string& path);

/// The same where a plane mesh is wanted (plane_of()).
LoadedMesh read_mesh(const std::string& path);

/// Throw InputError unless the suffix is that of a format which is read, or written.
void require_readable_suffix(const std::string& path);
void require_writable_suffix(const std::string& path);

/// Writes a mesh that the set's only rank holds whole, with its solution and blocks as far as the format has
/// a place for them. The format must be one that has a place for a mesh; where none is named it is that of
/// the suffix. Throws OutputError.
void write_mesh(OutputSet& outputs, const LoadedMesh& whole, const std::string& path,
                const std::string& format = {});

/// The same for the mesh that the root rank of `comm` holds, as the only file of a set. *Collective.* Throws
/// OutputError on all ranks.
void write_mesh_of_root(const Communicator& comm, const LoadedMesh& whole, const std::string& path,
                        const std::string& format = {});

/// Writes a distributed mesh in the format that the suffix tells, which must be one, with a solution where
/// the format has a place for one. A file that holds the solution alone (.csv; write_su2_csv() wants `gamma`)
/// is not written without one. *Collective.* Throws OutputError on all ranks.
void write_mesh(OutputSet& outputs, const Mesh& mesh, const std::string& path,
                const Field* solution = nullptr, double gamma = 1.4);

/// Throws InputError unless the suffix is that of a format which 3D meshes are written in.
void require_solid_suffix(const std::string& path);

/// Writes a 3D mesh, extruded, or held whole by the set's only rank, in the format of that name, or else of
/// the suffix, which must be one for 3D meshes. *Collective.* Throws OutputError on all ranks.
void write_mesh(OutputSet& outputs, const ExtrudedMesh& mesh, const std::string& path,
                const std::string& format = {});
void write_mesh(OutputSet& outputs, const FileMesh& mesh, const std::string& path,
                const std::string& format = {});

/// Takes the boundaries between two blocks out of a plane mesh with several of them: in space they lie inside
/// the mesh. What that loses, a line each, with the output's name.
std::vector<std::string> drop_interfaces(LoadedMesh& whole, const std::string& path);

/// One line that counts the boundaries whose names the format, or else that of the suffix, cannot hold, and
/// says how the first is written; none where all are kept.
std::vector<std::string> renames_in(const Mesh& mesh, const std::string& path,
                                    const std::string& format = {});

/// What the format, or else that of the suffix, has no place for and the mesh has: one line each, with the
/// file's name; renames among them. Of a distributed mesh the same on every rank; `solution` may be null.
std::vector<std::string> losses_in(const LoadedMesh& whole, const std::string& path,
                                   const std::string& format = {});
std::vector<std::string> losses_in(const FileMesh& mesh, const std::string& path,
                                   const std::string& format = {});
std::vector<std::string> losses_in(const ExtrudedMesh& mesh, const std::string& path);
std::vector<std::string> losses_in(const Mesh& mesh, const Field* solution, const std::string& path);

}  // namespace quadloop
