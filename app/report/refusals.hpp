#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/model/loaded_mesh.hpp"
#include "mesher/mesh/check/validate.hpp"

namespace quadloop::app {

/// Returns "; 2 faults more", or an empty string.
std::string more_faults(std::int64_t count);

/// Throws InputError with the first error, its location, and the number of others.
[[noreturn]] void refuse_invalid(const std::string& file, const std::vector<MeshFault>& faults);

/// Returns a warning if a mesh that is passed on unchanged is not valid: its first error, and the number of
/// others. Otherwise empty.
std::vector<std::string> doubts_about(const io::LoadedMesh& loaded, const std::string& file);

/// Throws InputError for a mesh that cannot be made valid by moving its nodes.
void require_sound_topology(const io::LoadedMesh& loaded, const std::string& file);

/// Throws InputError for a mesh that is not valid.
void require_valid_input(const io::LoadedMesh& loaded, const std::string& file);

/// Throws InputError for a smoothed mesh that may not be written, with the location of its worst cell if
/// cells are still inverted, else its first error.
void require_valid(const io::LoadedMesh& smoothed, const std::string& file);

}  // namespace quadloop::app
