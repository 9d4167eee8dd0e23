#pragma once

#include <string>
#include <vector>

#include "app/report/figures.hpp"
#include "app/report/summary.hpp"
#include "mesher/partition/mesh_part.hpp"

namespace quadloop {

/// How many parts, and how good they are for a solver.
void add_parts(Figures& figures, const PartFigures& parts);

/// The same in a mesh's summary; `files` are those of the set, the index first.
void add_parts(MeshSummary& summary, const PartFigures& parts, const std::vector<std::string>& files);

}  // namespace quadloop
