#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/model/loaded_mesh.hpp"
#include "mesher/mesh/check/validate.hpp"

namespace quadloop {

/// "; 2 faults more", or nothing.
std::string more_faults(std::int64_t count);

/// Throws InputError with the first fault, its place, and how many more there are.
[[noreturn]] void refuse_invalid(const std::string& file, const std::vector<MeshFault>& faults);

/// A warning where a mesh that is passed on as it is is not valid: its first fault, and how many more there
/// are. Otherwise empty.
std::vector<std::string> doubts_about(const LoadedMesh& loaded, const std::string& file);

/// Throws InputError for a mesh that no movement of its nodes can make valid.
void require_sound_topology(const LoadedMesh& loaded, const std::string& file);

/// Throws InputError for a mesh that is not valid.
void require_valid_input(const LoadedMesh& loaded, const std::string& file);

/// Throws InputError for a smoothed mesh that may not be written: where its worst cell is, if cells are still
/// inverted; else its first fault.
void require_valid(const LoadedMesh& smoothed, const std::string& file);

}  // namespace quadloop
