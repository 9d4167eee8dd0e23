#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "flow/euler/implicit/colouring.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"

namespace quadloop::flow::euler {

/// Consecutive nodes, each coupled far more strongly to its predecessor and successor than to other
/// neighbours, as across a stack of thin cells.
struct NodeLine {
  std::vector<GlobalNodeId> nodes;  ///< from the more strongly coupled end
  std::int8_t colour = 0;           ///< of the first node
};

/// Returns the complete lines in which this rank owns a node. Their order does not depend on the number of
/// ranks, only the selection does. Lines follow from face sizes and edge lengths alone (after Mavriplis
/// 1998): the coupling of an edge is face over length; two nodes are joined if for both the edge is one of
/// the two strongest and at least ten times as strong as the third. Cells of moderate aspect ratio have no
/// lines. *Collective.*
std::vector<NodeLine> find_lines(const Communicator& comm, const DualMesh& mesh, const Colouring& colours);

}  // namespace quadloop::flow::euler
