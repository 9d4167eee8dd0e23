#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// For each of `points` the index of one of the `known` points with the same coordinates, for two lists in a
/// similar order: searched near the position of the last match, and among a regular subset of the known
/// points. -1 if there is none or none is found in this way.
std::vector<std::int32_t> find_in_order(std::span<const Point> known, std::span<const Point> points);

/// Flags owned nodes that are completely surrounded by cells, on whatever ranks: interior nodes, even if
/// boundary edges are not listed. No two of them coincide. *Collective.*
NodeFlags inner_nodes(const Communicator& comm, const Mesh& mesh);

/// For the positions of a new mesh's owned nodes, the local interior node of the old mesh at the same place;
/// -1 if none is found. Two meshes number their nodes along one curve, so most unchanged nodes are found
/// without a search. Boundary nodes are excluded: two of them may coincide, and the choice must not depend on
/// the ranks.
std::vector<std::int32_t> unchanged_nodes(const Mesh& old_mesh, const NodeFlags& is_inner,
                                          std::span<const Point> places);

}  // namespace quadloop::adapt
