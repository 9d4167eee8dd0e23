#pragma once

#include <string>

namespace quadloop {

/// The absolute path of the program that a user names `name`: looked up in `search` (as PATH: folders with
/// colons between them) where it has no slash, else relative to `folder`. An InputError where there is no
/// such file, or none that may be run; it begins with `where`.
std::string find_program(const std::string& name, const std::string& search, const std::string& folder,
                         const std::string& where = "[solver] command");

}  // namespace quadloop
