#pragma once

#include <memory>
#include <string>
#include <vector>

#include "io/files/interruption.hpp"

namespace quadloop {

/// Makes a folder that is itself an output, unless it is there already; a new one is registered, to be removed
/// unless its files become whole. Throws OutputError where it cannot be made, or holds anything but `files`
/// (names that begin with a dot do not count). On one rank.
std::unique_ptr<Temporary> make_output_folder(const std::string& path, const std::vector<std::string>& files);

}  // namespace quadloop
