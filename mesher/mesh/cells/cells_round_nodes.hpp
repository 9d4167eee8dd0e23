#pragma once

#include <span>
#include <vector>

#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop {

/// Area and centroid of a cell given by its corners, counter-clockwise. A cell without area has the mean of
/// its corners.
struct CellShape {
  double area = 0;
  Point centroid;
  Point from_first;  ///< centroid relative to the first corner: more accurate far from the origin
};
CellShape shape_of(std::span<const Point> corners);

/// Returns the shapes of this rank's cells, triangles, then quads.
std::vector<CellShape> cell_shapes(const Mesh& mesh);

/// Values of one variable in the cells around a node.
struct AroundNode {
  double smallest = 0, largest = 0;  ///< over the cells that touch the node
  Point gradient;                    ///< by least squares from the cell averages at the centroids
  bool has_gradient = false;         ///< false if the centroids lie on one line (at corners of the domain)
};

/// The cells around each node; evaluates any number of variables.
class CellsRoundNodes {
 public:
  /// `mesh` must outlive it. *Collective.*
  CellsRoundNodes(const Communicator& comm, const Mesh& mesh);

  /// Returns the values at owned nodes and ghosts, from one value for each cell of this rank. The gradient is
  /// exact for linear functions sampled at the centroids. Bitwise independent of the number of ranks.
  /// *Collective.*
  std::vector<AroundNode> of(const std::vector<double>& of_cells) const;

  const std::vector<CellShape>& shapes() const { return shapes_; }  ///< of this rank's cells

 private:
  const Communicator& comm_;
  const Mesh& mesh_;
  HaloMesh halo_;
  std::vector<CellShape> shapes_, halo_shapes_;
};

}  // namespace quadloop
