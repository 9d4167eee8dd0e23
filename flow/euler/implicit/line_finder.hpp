#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "flow/euler/implicit/colouring.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"

namespace quadloop::euler {

/// Nodes in a row, each coupled far more strongly to the ones before and after it than to its other
/// neighbours, as across a stack of thin cells.
struct NodeLine {
  std::vector<GlobalNodeId> nodes;  ///< from the more strongly coupled end on
  std::int8_t colour = 0;           ///< that of the first
};

/// The lines in which this rank owns a node, whole, in an order that does not depend on the number of ranks
/// but for which of them are here. They follow from faces and lengths of edges alone (after Mavriplis 1998):
/// an edge's coupling is face over length; two nodes are joined where for each of them the edge is one of the
/// two strongest and at least ten times as strong as the third. In cells of moderate shape there are none.
/// *Collective.*
std::vector<NodeLine> find_lines(const Communicator& comm, const DualMesh& mesh, const Colouring& colours);

}  // namespace quadloop::euler
