#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "io/model/loaded_mesh.hpp"
#include "mesher/mesh/check/validate.hpp"

namespace quadloop::app {

/// Returns "; 2 faults more", or an empty string.
std::string more_faults(std::int64_t count);

/// Throws InputError with the first error, its location, and the number of others.
[[noreturn]] void refuse_invalid(const std::string& file, const std::vector<MeshFault>& faults);

/// Returns the faults of a distributed mesh on the root. It is gathered only if it is not certainly valid.
/// *Collective.*
std::vector<MeshFault> faults_of(const Communicator& comm, const io::LoadedMesh& loaded);

/// Returns a warning if a distributed mesh that is passed on unchanged is not valid: its first error, and the
/// number of others. Otherwise empty. *Collective.*
std::vector<std::string> doubts_about(const Communicator& comm, const io::LoadedMesh& loaded,
                                      const std::string& file);

/// Repairs a mesh (io::tidy_mesh()), then calls `check(mesh)` on the root, which has it whole, and which may
/// throw InputError. Does nothing if the mesh is certainly valid and of one block: then it is not gathered.
/// *Collective.*
void repair(const Communicator& comm, io::LoadedMesh& mesh, const std::string& file,
            const std::function<void(const io::LoadedMesh&)>& check);

/// Throws InputError for a mesh, whole on this rank, that cannot be made valid by moving its nodes.
void require_sound_topology(const io::LoadedMesh& loaded, const std::string& file);

/// Throws InputError for a distributed mesh that is not valid. It is gathered only if it is not certainly
/// valid. *Collective.*
void require_valid_input(const Communicator& comm, const io::LoadedMesh& loaded, const std::string& file);

/// Throws InputError for a smoothed mesh that may not be written, with the location of its worst cell if
/// cells are still inverted, else its first error. *Collective.*
void require_valid(const Communicator& comm, const io::LoadedMesh& smoothed, const std::string& file);

}  // namespace quadloop::app
