#pragma once

#include <span>
#include <vector>

#include "adapt/sensor/recovery/scaled_field.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A symmetric matrix: second derivatives, in 1 / length^2.
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

/// Where values of a variable stand.
enum class ValuesAt { nodes, cells };

/// Absolute hessians at the nodes of a cell.
struct CellHessian {
  Hessian mean;
  double largest = 0;  ///< eigenvalue at any of the nodes
};

/// For each of this rank's cells, triangles, then quads, what there is at its nodes. At a node it is that of
/// the quadratic which fits, by least squares, the values round the node: those of the cells that touch it,
/// and, much less heavy, of the cells that touch these (of values of cells three rings). So it is exact for
/// quadratics, at walls, between leaves of different sizes, on triangles and quads; of values of cells, which
/// count at the centroids, but for the difference between a mean and the value there. What the points do not
/// tell (across a channel of one cell) is 0.
///
/// Layers do not count there: nodes of their front are fitted from outside alone. In layers of walls it is
/// the second derivative along the rows alone, as no split makes them thinner, and 0 in strips and in layers
/// of values of cells. What may be the rounding of the variable is 0. `field` has a value for each owned node
/// and copy, or for each cell. The same bits on any number of ranks. *Collective.*
std::vector<CellHessian> cell_hessians(const Communicator& comm, const Mesh& mesh, const ScaledField& field,
                                       ValuesAt at);

/// The absolute hessians that cell_hessians() recovers at the nodes, from outside of layers: at owned nodes
/// and copies; 0 within layers. `field` has a value for each of these. *Collective.*
std::vector<Hessian> node_hessians(const Communicator& comm, const Mesh& mesh, const ScaledField& field);

}  // namespace quadloop
