#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mesher/base/communicator.hpp"
#include "mesher/mesh/build_mesh.hpp"

namespace quadloop {

using StageSeconds = std::vector<std::pair<std::string, double>>;

/// The short table that `mesh` ends with: counts, quality, seconds of each stage (slowest rank and mean), memory, imbalance, files.
/// Text on the root rank, empty on the others. *Collective*; every rank names the same stages.
std::string summary_table(const Communicator& comm, const MeshResult& result, const StageSeconds& seconds, const std::vector<std::string>& files);

}  // namespace quadloop
