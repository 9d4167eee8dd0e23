#pragma once

#include <functional>
#include <string>

#include "io/model/loaded_mesh.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/tree_record.hpp"
#include "tests/support/temporary_folder.hpp"

namespace quadloop::test {

/// The rectangle [0, columns] x [0, 2] as two rows of unit squares, the lower ones quads, each upper one two
/// triangles; the boundaries "wall" (below and above) and "far field" (the sides). Whole on this rank.
Mesh sample_mesh(std::int32_t columns);

/// A strip of that mesh: the columns of its nodes at x = 1 to 3, upwards.
StripLayers strip_across(const Mesh& mesh, std::int32_t columns);

/// Two variables with rows that need all digits, and three constants.
Field sample_solution(const Mesh& mesh);

/// What this rank holds of a whole mesh: its share of the nodes and the cells, in order, and copies of the
/// nodes that they touch.
Mesh share_of(const Mesh& whole, int rank, int ranks);
Field share_of(const Field& whole, const Mesh& mesh, const Mesh& share);

/// This rank's share of `leaves` leaves with made-up numbers.
TreeRecord sample_tree(std::int32_t leaves, int rank, int ranks);

/// How an Error that `call` throws would end the program; `done` where it throws none.
ExitStatus status_of(const std::function<void()>& call);

void write_bytes(const std::string& path, const std::string& bytes);
std::size_t files_in(const std::string& folder);

/// Returns the condition that a boundary has after a mesh was written in the format and read again.
BoundaryCondition condition_back(const std::string& format, BoundaryCondition condition);

}  // namespace quadloop::test
