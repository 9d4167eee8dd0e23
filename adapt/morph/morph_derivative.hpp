#pragma once

#include <span>
#include <vector>

#include "adapt/morph/mesh_motion.hpp"

namespace quadloop {

/// The derivative of what morph_mesh() does to nodes, without smoothing, by the points of the new outline: a
/// matrix of two rows for each node and two columns for each point, which is never made, only multiplied.
/// Exact: by the same formulas, differentiated. The extent L of what moves counts as given; where `change`
/// moves nothing it is that of the boundaries which may move (MeshMotion::possible_reach).
class MorphDerivative {
 public:
  /// `mesh` as it is before the morph; `change` must outlive this. *Collective.* Throws InputError as
  /// boundary_motion() and image_shares(): `change.from` must have as many points as `change.to`.
  MorphDerivative(const Communicator& comm, const Mesh& mesh, const OutlineChange& change);

  /// How each owned node moves when each point of `change.to` moves as given, on every rank: the product of
  /// the matrix. Copies are not told. Linear in the nodes.
  std::vector<Point> velocity(std::span<const Point> of_points) const;

  /// From what a number J gains from the shift of each owned node after the morph, dJ/dX of an adjoint
  /// solution, to what it gains from that of each point of `change.to`, on every rank: the product of the
  /// transpose. The same bits on any number of ranks. *Collective.*
  std::vector<Point> gradient(std::span<const Point> of_nodes) const;

 private:
  std::vector<LinearMotion> rates(std::span<const Point> of_points) const;
  std::vector<LinearMotion> gradient_of_motions(std::span<const Point> of_nodes) const;

  const Communicator& comm_;
  MeshMotion motion_;
  std::vector<Point> images_;        ///< of each vertex of the mesh's outline
  std::vector<PointShares> shares_;  ///< and the points that it is a mean of
  std::size_t points_;
  double reach_;
};

}  // namespace quadloop
