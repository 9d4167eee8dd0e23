#pragma once

#include <string>
#include <vector>

#include "io/model/loaded_solution.hpp"

namespace quadloop {

/// Reads a file of any format that has a place for a solution, with a mesh or without (.csv, as SU2 leaves
/// its restart file), on the calling rank alone. Throws InputError, also where the file holds no values at
/// its nodes, two variables of one name, or a value that is not finite or beyond 1e150.
LoadedSolution read_solution(const std::string& path);

/// Throws InputError unless the suffix is one that read_solution() knows; it lists them.
void require_solution_suffix(const std::string& path);

/// Throws InputError unless the solution's mesh is `whole`, a mesh that the rank holds whole: as many nodes,
/// each within 1e-6 of the shortest cell edge at it, and the same cells in any order, as far as the file
/// tells. Names the file, and the count, node (from 1) or cell that differs.
void require_same_mesh(const LoadedSolution& solution, const Mesh& whole);

}  // namespace quadloop
