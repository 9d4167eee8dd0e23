#include "adapt/loop/template_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "adapt/solvers/openfoam_template.hpp"
#include "generate/digests.hpp"
#include "io/files/reading/input_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::adapt {

namespace {

namespace fs = std::filesystem;

void add_file(const fs::path& path, const std::string& name, CaseSettings& files) {
  try {
    files.emplace_back(template_key(name),
                       fmt::format("\"{:016x}\"", text_digest(io::read_input(path.string()))));
  } catch (const InputError&) {  // reported by the solver that needs the file
  }
}

void add_openfoam(const std::string& folder, CaseSettings& files) {
  try {
    for (const std::string& name : openfoam_template_files(folder))
      add_file(fs::path(folder) / name, name, files);
  } catch (const InputError&) {  // as above
  }
}

}  // namespace

CaseSettings template_files(const ChosenSolver& solver) {
  CaseSettings files;
  if (const auto* su2 = std::get_if<Su2Solver>(&solver))
    add_file(su2->config, fs::path(su2->config).filename(), files);
  if (const auto* openfoam = std::get_if<OpenfoamSolver>(&solver))
    add_openfoam(openfoam->case_template, files);
  std::ranges::sort(files);
  return files;
}

std::uint64_t template_digest(const CaseSettings& files) {
  std::string text;
  for (const auto& [key, digest] : files) text += key + " = " + digest + "\n";
  return text_digest(text);
}

}  // namespace quadloop::adapt
