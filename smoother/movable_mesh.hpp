#pragma once

#include <optional>
#include <vector>

#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/periodic_mesh.hpp"

namespace quadloop::smoother {

/// A mesh in which nodes move. The nodes on the two sides of a periodic pair are one node, with the cells on
/// both sides around it; they stay where the pairs cannot be joined (join_pairs()).
class MovableMesh {
 public:
  /// `pinned` flags owned nodes of the mesh that stay; may be empty. The mesh must outlive the object, with
  /// unchanged cells. *Collective.*
  MovableMesh(const Communicator& comm, Mesh& mesh, const NodeFlags& pinned);

  HaloMesh& halo() { return halo_; }
  /// The joined mesh, or the given one.
  const Mesh& mesh() const { return joined_ ? joined_->mesh : given_; }
  /// Null if no pairs are joined.
  const PeriodicMesh* joined() const { return joined_ ? &*joined_ : nullptr; }
  /// Flags the owned nodes of mesh() that stay; may be empty. A node stays if its partner does.
  const NodeFlags& pinned() const { return pinned_; }

  /// Copies the positions to the given mesh. Partners get exactly the images of their nodes. Returns flags of
  /// the nodes of the given mesh, ghosts included, that have moved since the last call. *Collective.*
  NodeFlags take_positions();
  /// Flags of the nodes of the halo mesh as flags of those of the given mesh, ghosts included; may be empty.
  /// *Collective.*
  NodeFlags in_given(NodeFlags flags) const;

 private:
  NodeFlags pinned_in(const NodeFlags& given) const;
  NodeFlags pinned_on_sides(NodeFlags pinned) const;
  NodeExchange exchange_of_given() const;

  const Communicator& comm_;
  Mesh& given_;
  std::optional<PeriodicMesh> joined_;
  NodeFlags pinned_;
  HaloMesh halo_;
  std::vector<Point> taken_;  ///< positions in the halo mesh at the last call, if pairs are joined
};

}  // namespace quadloop::smoother
