#pragma once

#include <optional>
#include <vector>

#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"
#include "mesher/mesh/mirror_images.hpp"

namespace quadloop::euler {

/// Makes a flow its own mirror image, on a mesh that is so.
class MirroredStates {
 public:
  /// None where the mesh is not its own image, or where the free stream does not run along the axis.
  /// Communicator and mesh must outlive it. *Collective.*
  static std::optional<MirroredStates> find(const Communicator& comm, const DualMesh& mesh,
                                            const FlowModel& model, MirrorAxis axis);

  /// Each owned node and its image get the mean of both. *Collective.*
  void average(std::vector<State>& states) const;

 private:
  MirroredStates(const Communicator& comm, const DualMesh& mesh, MirrorAxis axis, NodeImages images);

  const Communicator* comm_;
  const DualMesh* mesh_;
  MirrorAxis axis_;
  NodeImages images_;
};

}  // namespace quadloop::euler
