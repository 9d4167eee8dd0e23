#pragma once

#include <string>
#include <vector>

#include "io/model/check_solid.hpp"
#include "io/model/file_mesh.hpp"
#include "mesher/base/json.hpp"

namespace quadloop {

/// What `check` says of a 3D mesh: the table for people, and the record.
std::string solid_text(const FileMesh& mesh, const SolidFigures& figures, bool verbose);
JsonObject solid_record(const std::string& file, const FileMesh& mesh, const SolidFigures& figures);

/// Throws InputError with the first fault, its place, and how many more there are.
[[noreturn]] void refuse_invalid_solid(const std::string& file, const SolidFigures& figures);

/// A warning where a 3D mesh that is passed on as it is is not valid, with its first fault; otherwise empty.
std::vector<std::string> doubts_about(const FileMesh& mesh, const std::string& file);

}  // namespace quadloop
