#pragma once

#include <string>
#include <vector>

#include "mesher/base/json.hpp"
#include "mesher/solid/check_solid.hpp"
#include "mesher/solid/solid_mesh.hpp"

namespace quadloop {

/// What `check` says of a 3D mesh: the table for people, and the record.
std::string solid_text(const SolidMesh& mesh, const SolidFigures& figures, bool verbose);
JsonObject solid_record(const std::string& file, const SolidMesh& mesh, const SolidFigures& figures);

/// Throws InputError with the first fault, its place, and how many more there are.
[[noreturn]] void refuse_invalid_solid(const std::string& file, const SolidFigures& figures);

/// A warning where a 3D mesh that is passed on as it is is not valid, with its first fault; otherwise empty.
std::vector<std::string> doubts_about(const SolidMesh& mesh, const std::string& file);

}  // namespace quadloop
