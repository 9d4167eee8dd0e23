#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// For each of `points` the index of one of the `known` points with the same coordinates, where the two lists
/// follow each other: looked for a little behind and ahead of the place up to which the last was found, and
/// among every so many-th of all known ones. -1 where there is none or none was found so.
std::vector<std::int32_t> find_in_order(std::span<const Point> known, std::span<const Point> points);

/// Flags of this rank's owned nodes round which cells close a circle, on whatever ranks they are: those
/// within the mesh, also where boundary edges are not listed. No two of them lie at one place. *Collective.*
NodeFlags inner_nodes(const Communicator& comm, const Mesh& mesh);

/// Of the places of a new mesh's owned nodes those at which an inner node of the old mesh is known to lie, on
/// this rank; -1 for all others. Two meshes number their nodes along one curve, so most of those that stay
/// are found without a search. Nodes of the boundary are left out: two of them may lie at one place, and
/// which is meant must not depend on the ranks.
std::vector<std::int32_t> standing_nodes(const Mesh& old_mesh, const NodeFlags& is_inner,
                                         std::span<const Point> places);

}  // namespace quadloop
