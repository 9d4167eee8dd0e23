#pragma once

#include <string>
#include <vector>

#include "app/report/statistics.hpp"
#include "app/report/summary.hpp"
#include "mesher/partition/mesh_part.hpp"

namespace quadloop::app {

/// Adds the number of partitions, and their quality for a solver.
void add_parts(Statistics& statistics, const PartStatistics& parts);

/// Adds the same to a mesh's summary; `files` are those of the set, the index first.
void add_parts(MeshSummary& summary, const PartStatistics& parts, const std::vector<std::string>& files);

}  // namespace quadloop::app
