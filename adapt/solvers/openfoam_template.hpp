#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace quadloop {

/// A user's case of OpenFOAM's, which each cycle copies.
struct OpenfoamTemplate {
  std::vector<std::string> files;  ///< all that is copied, relative to the folder, sorted
  std::string application;         ///< of system/controlDict; Allrun where the case has one
};

/// Looks through a case before it is run: what quadloop and the application will read from it. Left out are
/// times, logs and whatever else is_left_by_openfoam(), and folders of adaptive runs, which hold a cycle_K.
/// Throws InputError, which names the file and what to change, where the folder has no system/controlDict, or
/// no fields in 0 or 0.orig that quadloop can read; where controlDict names no application (and there is no
/// Allrun), or has fields written in binary or compressed; for a link to nothing or to a folder that it
/// stands in, and what can be read by nobody. On the calling rank alone.
OpenfoamTemplate read_openfoam_template(const std::string& folder);

/// The files into another folder, which may lie inside the first. Throws InputError, OutputError.
void copy_openfoam_template(const std::string& from, const OpenfoamTemplate& given,
                            const std::filesystem::path& to);

/// Those files alone, without a look into them. Throws InputError.
std::vector<std::string> openfoam_template_files(const std::string& folder);

/// By its name a part of a case that OpenFOAM has left, or an earlier mesh: nothing of it is copied.
bool is_left_by_openfoam(const std::filesystem::path& path);

}  // namespace quadloop
