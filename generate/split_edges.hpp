#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/build/build_mesh.hpp"

namespace quadloop {

/// New nodes on a boundary edge, which is named by its global node numbers.
struct EdgeSplit {
  GlobalNodeId from, to;
  std::vector<Point> places;  ///< of the new nodes, from `from` to `to`
};

/// Divides boundary edges at the given places, and the cells at these edges into triangles. `splits` are the
/// same on every rank. Nodes that are added follow the first node of their edge. Throws InputError with the
/// place if a cell cannot be divided. *Collective.*
void split_edges(const Communicator& comm, std::vector<EdgeSplit> splits, MeshResult& result);

}  // namespace quadloop
