#pragma once

#include <string>

namespace quadloop::flow {

/// Returns the absolute path of the program `name`: searched in `search` (like PATH: folders separated by
/// colons) if it contains no slash, else relative to `folder`. Throws an InputError that begins with `where`
/// if there is no such file, or it is not executable.
std::string find_program(const std::string& name, const std::string& search, const std::string& folder,
                         const std::string& where = "[solver] command");

}  // namespace quadloop::flow
