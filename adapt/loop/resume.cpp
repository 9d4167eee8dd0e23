#include "adapt/loop/resume.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "adapt/remesh/own_mesh.hpp"
#include "adapt/remesh/remesh.hpp"
#include "adapt/solvers/cycle_paths.hpp"
#include "generate/digests.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/mesh_file.hpp"
#include "io/tree/tree_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::adapt {

namespace {

std::string cure_of(const std::string& folder) {
  return "; restore the file, or remove the folder " + folder +
         " and resume the run, which repeats that cycle";
}

std::string text_of_record(const std::string& path, const std::string& folder) {
  try {
    return io::read_input(path);
  } catch (const InputError&) {
    throw InputError(path + ": is missing or cannot be read" + cure_of(folder));
  }
}

RecordedCase record_in(const std::string& folder) {
  const std::string path = CyclePaths{folder}.record();
  const auto recorded = recorded_case(text_of_record(path, folder));
  if (!recorded) throw InputError(path + ": is not a complete record of a cycle" + cure_of(folder));
  return *recorded;
}

[[noreturn]] void refuse_another_case(const std::string& folder, const std::vector<ChangedSetting>& changes,
                                      bool same_geometry) {
  std::string what = "the settings were read by another version of quadloop";
  if (!changes.empty())
    what = text_of(changes);
  else if (!same_geometry)
    what = "the geometry in the files of geometry.file has changed";
  throw InputError(CyclePaths{folder}.record() + ": belongs to another case: " + what +
                   "; resume with the same settings, or use another folder");
}

/// Checks a further file of the mesh, for viewers. *Collective.*
void require_copy(const Communicator& comm, const std::string& path, std::int64_t nodes) {
  const io::LoadedMesh loaded = io::read_mesh(comm, path);
  if (comm.sum(loaded.mesh.owned_nodes) == nodes && loaded.solution) return;
  throw InputError(path + ": does not hold the mesh and the solution of the files beside it");
}

/// Reads a cycle. Throws InputError if a file is incomplete. *Collective.*
SolvedMesh read_cycle(const Communicator& comm, const CyclePaths& paths) {
  const std::string path = paths.native_mesh();
  io::LoadedMesh loaded = io::read_mesh(comm, path);
  if (!loaded.solution) throw InputError(path + ": contains no solution; a complete cycle has one");
  SolvedMesh solved = in_tree_order(comm, std::move(loaded.mesh), std::move(*loaded.solution),
                                    io::read_tree(comm, paths.tree()));
  solved.file = path;
  return solved;
}

/// Compares the solution with the digest in the cycle's record. *Collective.*
void require_untouched_solution(const Communicator& comm, const SolvedMesh& solved, const CyclePaths& paths,
                                const std::string& folder) {
  const std::uint64_t digest = solution_digest(comm, solved.mesh, solved.solution);
  comm.together([&] {
    const auto recorded = record_in(folder).solution_digest;
    if (recorded && *recorded != digest)
      throw InputError(paths.native_mesh() +
                       ": its solution is not the one that record.json was written for");
  });
}

}  // namespace

std::vector<std::string> require_same_run(const Communicator& comm, const std::string& folder,
                                          const CycleRecord& now) {
  std::vector<std::string> warnings;
  comm.together([&] {
    const RecordedCase recorded = record_in(folder);
    std::vector<ChangedSetting> refused;
    for (const ChangedSetting& change : changed_settings(recorded.settings, now.settings)) {
      if (may_change_in_a_run(change.key))
        warnings.push_back(text_of({change}) + "; the cycles up to " +
                           std::filesystem::path(folder).filename().string() + " remain unchanged");
      else
        refused.push_back(change);
    }
    if (recorded.case_digest != now.case_digest)
      refuse_another_case(folder, refused, recorded.geometry_digest == now.geometry_digest);
  });
  return warnings;
}

SolvedMesh read_earlier_cycle(const Communicator& comm, const std::string& folder) {
  try {
    const CyclePaths paths{folder};
    SolvedMesh solved = read_cycle(comm, paths);
    require_untouched_mesh(comm, solved, paths.native_mesh(), paths.tree());
    require_untouched_solution(comm, solved, paths, folder);
    for (const std::string& format : io::default_formats()) {
      if (format != io::native_format().name)
        require_copy(comm, paths.mesh(format), solved.tree.attributes.nodes);
    }
    return solved;
  } catch (const InputError& fault) {  // the same on every rank
    throw InputError(fault.what() + cure_of(folder));
  }
}

CycleValues read_earlier_values(const Communicator& comm, const std::string& folder) {
  CycleValues values;
  comm.together([&] { values = recorded_values(text_of_record(CyclePaths{folder}.record(), folder)); });
  return values;
}

}  // namespace quadloop::adapt
