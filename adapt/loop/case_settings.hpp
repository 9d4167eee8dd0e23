#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace quadloop::adapt {

/// The keys of a case that a run's files depend on: dotted names in ascending order, each with its value as
/// JSON on one line.
using CaseSettings = std::vector<std::pair<std::string, std::string>>;

/// A key whose value has changed; an empty value means that the key is absent.
struct ChangedSetting {
  std::string key, before, now;
};

/// Returns the key that stores the digest of a file of the user's SU2 or OpenFOAM case; `file` is its name
/// there.
std::string template_key(const std::string& file);

std::vector<ChangedSetting> changed_settings(const CaseSettings& before, const CaseSettings& now);

/// Whether a run may be resumed after a change of this key: it affects how the solution of a cycle is reached
/// and which files are written, not the problem that is solved. A user may repair solver arguments or the
/// template after a failure, or allow more steps; complete cycles are kept.
bool may_change_in_a_run(const std::string& key);

/// Whether the cells at boundaries depend on this key: spacing, corners and layers of a boundary.
bool shapes_cells_at_boundaries(const std::string& key);

/// Returns a hash of the geometry and of every setting that may not change in a run. Settings are compared as
/// the text of their values: a file that a key names counts by its name only. The geometry that geometry.file
/// names is represented by `geometry_digest` (Geometry). If another key names a file, the digest of its
/// contents must be added here.
std::uint64_t run_digest(const CaseSettings& settings, std::uint64_t geometry_digest);

/// Returns "was a, is now b" for each change; for a template file that it has changed.
std::string text_of(const std::vector<ChangedSetting>& changes);

}  // namespace quadloop::adapt
