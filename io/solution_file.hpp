#pragma once

#include <string>
#include <vector>

#include "io/model/loaded_solution.hpp"

namespace quadloop::io {

/// Reads a file of any format that supports solutions, with or without a mesh (.csv, the restart file of
/// SU2); it is distributed in the order of the file. Throws InputError on all ranks, also if the file has no
/// solution, two variables of the same name, or a value that is not finite or exceeds 1e150. *Collective.*
LoadedSolution read_solution(const Communicator& comm, const std::string& path);
/// The same on the calling rank only: whole.
LoadedSolution read_solution(const std::string& path);

/// Throws InputError unless read_solution() supports the suffix; the message lists those supported.
void require_solution_suffix(const std::string& path);

/// Throws InputError unless the solution's mesh is `mesh`, which has even shares in the order of its file:
/// the same number of nodes, each within 1e-6 of the shortest cell edge at it, and the same cells in any
/// order, as far as the file contains these. The message names the file, and the differing count, node (from
/// 1) or cell. *Collective.*
void require_same_mesh(const Communicator& comm, const LoadedSolution& solution, const Mesh& mesh);
/// The same on the calling rank only.
void require_same_mesh(const LoadedSolution& solution, const Mesh& whole);

}  // namespace quadloop::io
