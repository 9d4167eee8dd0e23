#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "adapt/morph/boundary_motion.hpp"
#include "adapt/morph/inverse_distance.hpp"
#include "adapt/morph/layer_motion.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop {

/// What moves each node of a mesh whose outline changes: its boundary nodes, on every rank; which nodes go
/// with one of them as one piece; and the lines that all others follow.
class MeshMotion {
 public:
  /// `mesh` must outlive it and keep its cells; its nodes may move. *Collective.* Throws InputError as
  /// boundary_motion().
  MeshMotion(const Communicator& comm, const Mesh& mesh, const OutlineChange& change);

  const BoundaryOutline& outline() const { return outline_; }
  const std::vector<BoundaryNodeMotion>& boundary() const { return boundary_; }
  /// The mesh with its nodes where they were.
  const HaloMesh& before() const { return halo_; }
  const LayerPlaces& places() const { return places_; }  ///< of the mesh's nodes

  /// The extent of those boundaries that move; 0 where none does.
  double reach() const { return reach_; }
  /// The same; where none moves, of those that may: of the loops inside the domain that have an image, or
  /// where there are none of all that have one.
  double possible_reach(const OutlineChange& change) const;

  /// Which of boundary() an owned node goes with; below 0: it follows the field.
  std::int32_t foot(NodeId node) const { return feet_[node]; }
  bool is_boundary(NodeId node) const {
    return feet_[node] >= 0 && boundary_[feet_[node]].node == halo_.global(node);
  }

  /// A node of boundary or front, in the place of the wall below, with the width that it stands for.
  struct Source {
    std::int32_t foot;
    double width;
  };
  const std::vector<Source>& sources() const { return sources_; }  ///< the same on every rank
  /// What the plane follows when boundary node k moves as `motion_of(k)` says.
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

}  // namespace quadloop
