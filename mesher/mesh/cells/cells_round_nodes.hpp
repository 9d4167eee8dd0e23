#pragma once

#include <span>
#include <vector>

#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop {

/// The area and the centroid of a cell with these corners, counter-clockwise. The mean of the corners where
/// it has no area.
struct CellShape {
  double area = 0;
  Point centroid;
  Point from_first;  ///< the centroid from the first corner: far from the origin it has more digits
};
CellShape shape_of(std::span<const Point> corners);

/// Of this rank's cells, its triangles, then its quads.
std::vector<CellShape> cell_shapes(const Mesh& mesh);

/// What the cells round a node tell of one of their variables.
struct AroundNode {
  double smallest = 0, largest = 0;  ///< of the cells that touch the node
  Point gradient;                    ///< by least squares, the cells' means at their centroids
  bool has_gradient = false;         ///< not where their centroids lie on one line (at corners of the domain)
};

/// The cells round each node, to be asked for one variable after another.
class CellsRoundNodes {
 public:
  /// `mesh` must outlive it. *Collective.*
  CellsRoundNodes(const Communicator& comm, const Mesh& mesh);

  /// At this rank's owned nodes and copies, from one value for each of its cells. The gradient is exact for
  /// values of a linear function at the centroids. The same bits on any number of ranks. *Collective.*
  std::vector<AroundNode> of(const std::vector<double>& of_cells) const;

  const std::vector<CellShape>& shapes() const { return shapes_; }  ///< of this rank's cells

 private:
  const Communicator& comm_;
  const Mesh& mesh_;
  HaloMesh halo_;
  std::vector<CellShape> shapes_, halo_shapes_;
};

}  // namespace quadloop
