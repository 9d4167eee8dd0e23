#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mesher/base/communicator.hpp"
#include "mesher/mesh/build_mesh.hpp"

namespace quadloop {

using StageSeconds = std::vector<std::pair<std::string, double>>;

/// Seconds of each stage, on the slowest rank and in the mean: text on every rank. *Collective*; every rank names the same stages.
std::string stage_table(const Communicator& comm, const StageSeconds& seconds);

/// The short table that `mesh` ends with: counts, quality, seconds of each stage (slowest rank and mean), memory, imbalance, files.
/// Text on the root rank, empty on the others. *Collective*; every rank names the same stages.
std::string summary_table(const Communicator& comm, const MeshResult& result, const StageSeconds& seconds, const std::vector<std::string>& files);

}  // namespace quadloop
