#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "adapt/morph/boundary_motion.hpp"
#include "adapt/morph/inverse_distance.hpp"
#include "adapt/morph/layer_motion.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop::adapt {

/// Motion of each node of a mesh whose boundary changes: its boundary nodes, on every rank; the nodes that
/// move rigidly with one of them; and the lines that all others follow.
class MeshMotion {
 public:
  /// `mesh` must outlive the object with unchanged cells; its nodes may move. Throws InputError as
  /// boundary_motion() does. *Collective.*
  MeshMotion(const Communicator& comm, const Mesh& mesh, const OutlineChange& change);

  const BoundaryOutline& outline() const { return outline_; }
  const std::vector<BoundaryNodeMotion>& boundary() const { return boundary_; }
  /// The mesh with its original node positions.
  const HaloMesh& before() const { return halo_; }
  const LayerPlaces& places() const { return places_; }  ///< of the mesh's nodes

  /// Extent of the moving boundaries; 0 if none moves.
  double reach() const { return reach_; }
  /// The same or, if none moves, the extent of those that may move: of the loops inside the domain that have
  /// an image or, if there are none, of all that have one.
  double possible_reach(const OutlineChange& change) const;

  /// Index in boundary() of the node that an owned node moves with; negative: it follows the field.
  std::int32_t foot(NodeId node) const { return feet_[node]; }
  bool is_boundary(NodeId node) const {
    return feet_[node] >= 0 && boundary_[feet_[node]].node == halo_.global(node);
  }

  /// A node of a boundary or of an outer edge of layers (instead of the wall below), with the width that it
  /// represents.
  struct Source {
    std::int32_t foot;
    double width;
  };
  const std::vector<Source>& sources() const { return sources_; }  ///< the same on every rank
  /// Returns the motion field of the plane if boundary node k moves by `motion_of(k)`.
  template <class MotionOf>
  InverseDistance field(double reach, const MotionOf& motion_of) const {
    std::vector<MotionSource> sources;
    sources.reserve(sources_.size());
    for (const auto& [foot, width] : sources_)
      sources.push_back({boundary_[foot].motion.from, width, motion_of(foot)});
    return {sources, reach};
  }

 private:
  void gather_sources(const Communicator& comm, const LayerPlaces& places);

  HaloMesh halo_;
  LayerPlaces places_;
  BoundaryOutline outline_;
  std::vector<BoundaryNodeMotion> boundary_;
  NodeFeet feet_;
  std::vector<Source> sources_;
  double reach_ = 0;
};

}  // namespace quadloop::adapt
