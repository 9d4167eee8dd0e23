#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace quadloop {

/// The keys of a case that a run's files depend on, by their dotted names in ascending order, each with its
/// value as JSON on one line.
using CaseSettings = std::vector<std::pair<std::string, std::string>>;

/// A key whose value has changed; empty where there was or is none.
struct ChangedSetting {
  std::string key, before, now;
};

/// The key under which the digest of a file stands that belongs to the user's case for SU2 or OpenFOAM, by
/// its name there.
std::string template_key(const std::string& file);

std::vector<ChangedSetting> changed_settings(const CaseSettings& before, const CaseSettings& now);

/// Whether a run may be gone on with after a change of this key: how a cycle's flow is reached and which
/// files show it, not what is solved. A user mends the arguments of his solver or its case after a failure,
/// or gives it more steps; the cycles that are whole stay as they are.
bool may_change_in_a_run(const std::string& key);

/// Whether the cells at boundaries depend on this key: spacing, corners and layers of a boundary.
bool shapes_cells_at_boundaries(const std::string& key);

/// A number that changes with the outline and with every setting that may not change in a run. Settings are
/// compared as the text of their values: a file that a key names counts by its name alone. The outline, which
/// geometry.file names, is in it by `geometry_digest`, that of Geometry; a case that comes to name another
/// file needs the digest of what stands in that one here too.
std::uint64_t run_digest(const CaseSettings& settings, std::uint64_t geometry_digest);

/// "was a, is now b" of each change, one after another; of a file of a template that it has changed.
std::string text_of(const std::vector<ChangedSetting>& changes);

}  // namespace quadloop
