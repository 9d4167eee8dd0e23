#pragma once

#include <cstdint>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop::io {

/// Whether orient_cells() certainly has nothing to reverse: all cells are counter-clockwise, and no two have
/// an edge in the same direction. Linear.
bool surely_oriented(const Mesh& mesh, const EdgeTable& table);

/// The same for a distributed mesh. *Collective.*
bool surely_oriented(const Communicator& comm, const Mesh& mesh);

/// Reverses cells of a mesh that is whole on this rank such that cells traverse a shared edge in opposite
/// directions, and the signed areas of each component (cells connected by edges of two cells) have a positive
/// sum. The orientation of a cell is thus consistent with its neighbours: one that was inverted by moved
/// nodes remains inverted. Edges of more than two cells do not connect. Components without a consistent
/// orientation (a Moebius strip), or with zero total area, are unchanged and left to validate(). Returns the
/// number of reversed cells. The cells' nodes must exist. O(n log n).
std::int64_t orient_cells(Mesh& mesh);

}  // namespace quadloop::io
