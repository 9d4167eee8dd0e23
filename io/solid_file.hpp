#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/loaded/loaded_mesh.hpp"
#include "mesher/solid/extruded_mesh.hpp"
#include "mesher/solid/solid_mesh.hpp"

namespace quadloop {

/// Throws InputError unless the suffix is that of a format which 3D meshes are written in.
void require_solid_suffix(const std::string& path);

/// Writes it in the format of that name, or else of the suffix. *Collective.* Throws OutputError on all
/// ranks.
void write_solid(OutputSet& outputs, const ExtrudedMesh& mesh, const std::string& path,
                 const std::string& format = {});

/// The same for one that the set's only rank holds whole.
void write_solid(OutputSet& outputs, const SolidMesh& mesh, const std::string& path,
                 const std::string& format = {});

/// The 3D mesh in a file, on the calling rank alone; nothing where the format has none, or the file holds a
/// plane one. What comes through a pipe is taken for a plane one. Throws InputError.
std::optional<SolidMesh> read_solid(const std::string& path);

/// Takes the boundaries between two blocks out of a plane mesh with several of them: in space they lie inside
/// the mesh. What that loses, a line each, with the output's name.
std::vector<std::string> drop_interfaces(LoadedMesh& whole, const std::string& path);

/// What the format of the suffix has no place for and the mesh has: one line each, with the file's name; that
/// an end has another name than "front" or "back" among them. The same on every rank.
std::vector<std::string> losses_in(const ExtrudedMesh& mesh, const std::string& path);

/// The same for one that is held, in the format of that name, or else of the suffix.
std::vector<std::string> losses_in(const SolidMesh& mesh, const std::string& path,
                                   const std::string& format = {});

}  // namespace quadloop
