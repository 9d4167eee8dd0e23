#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// A place on a boundary edge, on the rank that has the edge; the index counts through the mesh's boundaries
/// in order.
struct BoundaryPlace {
  std::int32_t rank = 0, edge = 0;
  double parameter = 0;  ///< along the edge, 0 at its first node
};

/// The boundary edges of all ranks except those of inner lines, copied to each rank (they are few compared
/// with the cells), with a search for the nearest one.
class NearestBoundary {
 public:
  /// *Collective.*
  NearestBoundary(const Communicator& comm, const Mesh& mesh);
  ~NearestBoundary();
  NearestBoundary(const NearestBoundary&) = delete;
  NearestBoundary& operator=(const NearestBoundary&) = delete;

  /// The lowest-numbered of equally near edges; numbers run through the boundaries in order, and within one
  /// through the ranks.
  BoundaryPlace nearest(Point p) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

/// This rank's boundary edges, by the index of BoundaryPlace.
std::vector<std::array<NodeId, 2>> boundary_edges_of(const Mesh& mesh);

}  // namespace quadloop::adapt
