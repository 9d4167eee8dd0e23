#pragma once

#include <span>
#include <vector>

#include "adapt/sensor/recovery/scaled_field.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// A symmetric 2 x 2 matrix of second derivatives, in 1 / length^2.
struct Hessian {
  double xx = 0, xy = 0, yy = 0;

  friend Hessian operator+(const Hessian& a, const Hessian& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
  }
  friend Hessian operator*(double factor, const Hessian& h) {
    return {factor * h.xx, factor * h.xy, factor * h.yy};
  }
  friend bool operator==(const Hessian&, const Hessian&) = default;
};

/// The matrix with the same eigenvectors and the absolute eigenvalues.
Hessian absolute(const Hessian& h);

/// The largest absolute eigenvalue.
double largest_eigenvalue(const Hessian& h);

/// e^T h e.
double along(const Hessian& h, Point e);

/// Location of a variable's values.
enum class ValuesAt { nodes, cells };

/// Absolute Hessians at the nodes of a cell.
struct CellHessian {
  Hessian mean;
  double largest = 0;  ///< largest eigenvalue at any of the nodes
};

/// For each local cell (triangles, then quadrilaterals) the Hessians at its nodes. The Hessian at a node is
/// that of the quadratic fitted by least squares to the values around it: values in the cells that touch the
/// node and, with a much smaller weight, in the cells that touch these (for cell values three rings). So it
/// is exact for quadratics, at walls, between leaves of different sizes, on triangles and quadrilaterals.
/// Cell values are located at the centroids; there it is exact up to the difference between mean and point
/// value. Derivatives that the points do not determine (across a channel of one cell) are 0.
///
/// Cells in layers are excluded: nodes on the outer edge of layers are fitted from outside only. In wall
/// layers the Hessian is the second derivative along the rows only, as splitting does not make the rows
/// thinner; it is 0 in strips and, for cell values, in layers. Values within the rounding of the variable
/// count as 0. `field` has a value for each owned node and ghost copy, or for each cell. The same bits on any
/// number of ranks. *Collective.*
std::vector<CellHessian> cell_hessians(const Communicator& comm, const Mesh& mesh, const ScaledField& field,
                                       ValuesAt at);

/// The absolute Hessians that cell_hessians() recovers at owned nodes and ghost copies from the cells outside
/// layers; 0 within layers. `field` has a value for each of these nodes. *Collective.*
std::vector<Hessian> node_hessians(const Communicator& comm, const Mesh& mesh, const ScaledField& field);

}  // namespace quadloop::adapt
