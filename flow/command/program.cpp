#include "flow/command/program.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>

#include "mesher/base/error.hpp"

namespace quadloop::flow {

namespace {

bool is_file(const std::string& path) {
  struct stat found = {};
  return ::stat(path.c_str(), &found) == 0 && S_ISREG(found.st_mode);
}

bool may_be_run(const std::string& path) { return ::access(path.c_str(), X_OK) == 0; }

[[noreturn]] void refuse(const std::string& where, const std::string& name, const std::string& fault) {
  throw InputError(where + ": the program '" + name + "' " + fault);
}

/// Throws for a name that is not a program.
[[noreturn]] void refuse_unknown(const std::string& where, const std::string& name,
                                 const std::string& fault) {
  if (name.find(' ') == std::string::npos) refuse(where, name, fault);
  refuse(where, name,
         R"(is not there; command is a list of the program and its arguments, as in )"
         R"(["python3", "{case}/my_solver.py", "{mesh}"])");
}

/// `name` contains a slash.
std::string program_at(const std::string& name, const std::string& folder, const std::string& where) {
  std::string path = std::filesystem::path(folder) / name;
  if (!is_file(path)) {
    const bool relative = name.front() != '/';
    refuse_unknown(where, name,
                   relative ? "is not in the folder of the cycle, where the run starts; write {case}/" +
                                  name + " for one beside the case file"
                            : "is no file; correct its path");
  }
  if (!may_be_run(path)) refuse(where, name, "may not be run; allow it with: chmod +x " + path);
  return path;
}

}  // namespace

std::string find_program(const std::string& name, const std::string& search, const std::string& folder,
                         const std::string& where) {
  if (name.empty()) refuse(where, name, "has no name; the first argument of the command is the program");
  if (name.find('/') != std::string::npos) return program_at(name, folder, where);
  std::istringstream folders(search);
  for (std::string candidate; std::getline(folders, candidate, ':');) {
    std::string path = std::filesystem::absolute(candidate.empty() ? "." : candidate) / name;
    if (is_file(path) && may_be_run(path)) return path;
  }
  refuse_unknown(where, name,
                 "is in no folder of PATH; install it, write its full path, or {case}/" + name +
                     " for one beside the case file");
}

}  // namespace quadloop::flow
