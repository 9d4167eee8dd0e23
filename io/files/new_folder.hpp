#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/files/interruption.hpp"

namespace quadloop::io {

/// Creates an output folder, unless it exists; a new one is registered for removal unless its files are
/// completed. Throws OutputError if it cannot be created, or contains anything but `files` (names that begin
/// with a dot are ignored). On one rank.
std::unique_ptr<Temporary> make_output_folder(const std::string& path, const std::vector<std::string>& files);

}  // namespace quadloop::io
