#pragma once

#include <optional>

#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"
#include "mesher/mesh/mirror_images.hpp"

namespace quadloop::flow::euler {

/// Makes a flow mirror-symmetric, on a mirror-symmetric mesh.
class MirroredStates {
 public:
  /// Empty if the mesh is not symmetric, or the free stream is not parallel to the axis. Communicator and
  /// mesh must outlive the object. *Collective.*
  static std::optional<MirroredStates> find(const Communicator& comm, const DualMesh& mesh,
                                            const FlowModel& model, MirrorAxis axis);

  /// Replaces the states of each owned node and its image by their mean. *Collective.*
  void average(IdVector<NodeId, State>& states) const;

 private:
  MirroredStates(const Communicator& comm, const DualMesh& mesh, MirrorAxis axis, NodeImages images);

  const Communicator* comm_;
  const DualMesh* mesh_;
  MirrorAxis axis_;
  NodeImages images_;
};

}  // namespace quadloop::flow::euler
