#include "quadloop/case/design_start.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "adapt/loop/record.hpp"
#include "adapt/remesh/own_mesh.hpp"
#include "adapt/remesh/remesh.hpp"
#include "adapt/solvers/cycle_paths.hpp"
#include "io/files/reading/input_file.hpp"
#include "io/input/geometry_file.hpp"
#include "io/mesh_file.hpp"
#include "io/tree/tree_file.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/mesh/check/quality.hpp"

namespace quadloop {

namespace {

namespace fs = std::filesystem;

bool is_there(const std::string& path) {
  std::error_code unreadable;
  return fs::exists(path, unreadable);
}

constexpr const char* what_from_takes =
    "--from takes the folder of a run of `quadloop adapt`, one of its cycles, or a mesh beside its tree";

/// Returns the folder of the last complete cycle of a run, or `from` itself if it is the folder of a cycle.
std::string cycle_folder(const std::string& from, std::vector<std::string>& warnings) {
  std::string last;
  for (int cycle = 0;; ++cycle) {
    const std::string folder = from + "/" + adapt::cycle_name(cycle);
    if (is_there(adapt::CyclePaths{folder}.record())) {
      last = folder;
      continue;
    }
    for (const std::string& torn : {folder, folder + ".part"}) {
      if (!last.empty() && is_there(torn))
        warnings.push_back(
            fmt::format("{}: is not whole (its record is missing); {} is begun with", torn, last));
    }
    break;
  }
  if (!last.empty()) return last;
  if (is_there(adapt::CyclePaths{from}.native_mesh())) return from;
  throw InputError(fmt::format("{}: holds no whole cycle to begin with; {}", from, what_from_takes));
}

/// Returns the settings in a cycle's record; empty if there is no record or it is incomplete.
adapt::CaseSettings settings_of_cycle(const adapt::CyclePaths& paths) {
  if (!is_there(paths.record())) return {};
  const auto recorded = adapt::recorded_case(io::read_input(paths.record()));
  return recorded ? recorded->settings : adapt::CaseSettings{};
}

/// Returns the settings of boundaries that have changed; empty if the former settings are not known.
std::string changes_at_boundaries(const adapt::CaseSettings& before, const adapt::CaseSettings& now) {
  if (before.empty()) return {};
  std::vector<adapt::ChangedSetting> changed = adapt::changed_settings(before, now);
  std::erase_if(changed, [](const adapt::ChangedSetting& change) {
    return !adapt::shapes_cells_at_boundaries(change.key);
  });
  return adapt::text_of(changed);
}

/// Finds the files without reading them.
FormerMesh files_of(const std::string& from) {
  FormerMesh former;
  if (!is_there(from)) throw InputError(fmt::format("{}: is not there; {}", from, what_from_takes));
  std::error_code unreadable;
  if (fs::is_directory(from, unreadable)) {
    const adapt::CyclePaths paths{cycle_folder(from, former.warnings)};
    former.mesh_file = paths.native_mesh();
    former.tree_file = paths.tree();
    former.outline_file = paths.outline();
    former.settings = settings_of_cycle(paths);
  } else {
    io::require_readable_suffix(from);
    const std::string stem = fs::path(from).replace_extension().string();
    former.mesh_file = from;
    former.tree_file = stem + io::tree_suffix;
    former.outline_file = stem + ".geom";
  }
  if (!is_there(former.tree_file))
    throw InputError(former.tree_file +
                     ": is not there; a run begins with a mesh and the tree that was written with it, "
                     "under the same name");
  if (!is_there(former.outline_file)) former.outline_file.clear();
  return former;
}

/// Reads the geometry of the mesh. Chains that form no closed loops, as of a mesh with inner lines, are kept
/// as they are.
void read_outline(FormerMesh& former) {
  std::vector<std::string> told_when_it_was_meshed;
  former.chains = io::read_geometry(former.outline_file, told_when_it_was_meshed);
  AssembleOptions options;
  options.domain_is_known = true;
  try {
    former.outline = assemble(former.chains, options, told_when_it_was_meshed);
  } catch (const InputError&) {
    former.outline.reset();
  }
}

}  // namespace

FormerMesh find_former_mesh(const Communicator& comm, const std::string& from) {
  FormerMesh former;
  comm.together([&] {
    former = files_of(from);
    if (!former.outline_file.empty()) read_outline(former);
  });
  former.tree = io::read_tree(comm, former.tree_file);
  return former;
}

adapt::DesignStart read_start(const Communicator& comm, FormerMesh& former, std::optional<double> morph_to,
                              const std::string& file, const adapt::CaseSettings& settings) {
  io::LoadedMesh loaded = io::read_mesh(comm, former.mesh_file);
  io::list_inner_curves(loaded);
  adapt::require_counts(count(comm, loaded.mesh), former.tree.attributes, former.mesh_file, former.tree_file);
  adapt::DesignStart start{adapt::in_tree_order(comm, std::move(loaded.mesh),
                                                loaded.solution.value_or(Field{}), std::move(former.tree)),
                           {}};
  start.solved.file = former.mesh_file;
  adapt::require_untouched_mesh(comm, start.solved, former.mesh_file, former.tree_file);
  if (morph_to)
    start.wish = adapt::MorphWish{
        *morph_to,           file,           former.outline ? &*former.outline : nullptr,
        former.outline_file, &former.chains, changes_at_boundaries(former.settings, settings)};
  return start;
}

}  // namespace quadloop
