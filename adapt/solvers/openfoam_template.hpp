#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quadloop::adapt {

/// A user's OpenFOAM case, which each cycle copies.
struct OpenfoamTemplate {
  std::vector<std::string> files;  ///< all files to copy, relative to the folder, sorted
  std::string application;         ///< of system/controlDict; Allrun if the case has one
};

/// Checks a case before it is run, for quadloop and for its application. Times, logs and other results
/// (is_left_by_openfoam()) are skipped, and so are folders of adaptive runs, which contain cycle_K. Throws
/// InputError, which names the file and the remedy, if the folder has no system/controlDict, or no fields in
/// 0 or 0.orig that quadloop can read; if controlDict names no application (and there is no Allrun), or
/// selects binary or compressed fields; for a link to nothing or to a folder that contains it, and for
/// unreadable files. On the calling rank only.
OpenfoamTemplate read_openfoam_template(const std::string& folder);

/// Copies the files to another folder, which may lie inside the first. Throws InputError, OutputError.
void copy_openfoam_template(const std::string& from, const OpenfoamTemplate& given,
                            const std::filesystem::path& to);

/// Returns the files without checking their contents. Throws InputError.
std::vector<std::string> openfoam_template_files(const std::string& folder);

/// Whether the name is that of an OpenFOAM result or an earlier mesh, which is not copied.
bool is_left_by_openfoam(const std::filesystem::path& path);

}  // namespace quadloop::adapt
