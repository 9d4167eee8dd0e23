#pragma once

#include <span>
#include <vector>

#include "adapt/morph/mesh_motion.hpp"

namespace quadloop::adapt {

/// Derivative of morph_mesh(), without smoothing, with respect to the points of the new geometry: a matrix
/// with two rows per node and two columns per point, which is never formed, only multiplied. Exact: the same
/// formulas, differentiated. The extent of what moves is held constant; if `change` moves nothing it is that
/// of the boundaries which may move (MeshMotion::possible_reach).
class MorphDerivative {
 public:
  /// `mesh` is the mesh before the morph; `change` must outlive the object. Throws InputError as
  /// boundary_motion() and image_shares() do: `change.from` must have as many points as `change.to`.
  /// *Collective.*
  MorphDerivative(const Communicator& comm, const Mesh& mesh, const OutlineChange& change);

  /// Matrix product: returns the velocity of each owned node for given velocities of the points of
  /// `change.to`, which are the same on every rank. Ghosts are not included. Linear in the number of nodes.
  std::vector<Point> velocity(std::span<const Point> of_points) const;

  /// Product with the transpose: converts the gradient dJ/dX of a functional J with respect to each owned
  /// node after the morph, e.g. from an adjoint solution, to that with respect to each point of `change.to`,
  /// on every rank. Bitwise independent of the number of ranks. *Collective.*
  std::vector<Point> gradient(std::span<const Point> of_nodes) const;

 private:
  std::vector<LinearMotion> rates(std::span<const Point> of_points) const;
  std::vector<LinearMotion> gradient_of_motions(std::span<const Point> of_nodes) const;

  const Communicator& comm_;
  MeshMotion motion_;
  std::vector<Point> images_;        ///< of each vertex of the mesh boundary
  std::vector<PointShares> shares_;  ///< and its weights of points
  std::size_t points_;
  double reach_;
};

}  // namespace quadloop::adapt
