#pragma once

#include <string>
#include <vector>

#include "io/model/check_mesh3d.hpp"
#include "io/model/file_mesh.hpp"
#include "mesher/base/json.hpp"

namespace quadloop::app {

/// Results of `check` for a 3D mesh: the table, and the record.
std::string mesh3d_text(const io::FileMesh& mesh, const io::Mesh3dStatistics& statistics, bool verbose);
JsonObject mesh3d_record(const std::string& file, const io::FileMesh& mesh,
                         const io::Mesh3dStatistics& statistics);

/// Throws InputError with the first error, its location, and the number of others.
[[noreturn]] void refuse_invalid_mesh3d(const std::string& file, const io::Mesh3dStatistics& statistics);

/// Returns a warning if a 3D mesh that is passed on unchanged is not valid, with its first error; otherwise
/// empty.
std::vector<std::string> doubts_about(const io::FileMesh& mesh, const std::string& file);

}  // namespace quadloop::app
