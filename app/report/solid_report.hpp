#pragma once

#include <string>
#include <vector>

#include "io/model/check_solid.hpp"
#include "io/model/file_mesh.hpp"
#include "mesher/base/json.hpp"

namespace quadloop {

/// Results of `check` for a 3D mesh: the table, and the record.
std::string solid_text(const FileMesh& mesh, const SolidFigures& figures, bool verbose);
JsonObject solid_record(const std::string& file, const FileMesh& mesh, const SolidFigures& figures);

/// Throws InputError with the first error, its location, and the number of others.
[[noreturn]] void refuse_invalid_solid(const std::string& file, const SolidFigures& figures);

/// Returns a warning if a 3D mesh that is passed on unchanged is not valid, with its first error; otherwise
/// empty.
std::vector<std::string> doubts_about(const FileMesh& mesh, const std::string& file);

}  // namespace quadloop
