#pragma once

#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::flow::euler {

/// The flow outside the far field: the free stream, optionally with the compressible point vortex of the lift
/// (Thomas and Salas 1986), for a subsonic free stream. The vortex is at the centre of the bounding box of
/// the walls with a force. Density and pressure follow from the speed by constant total enthalpy and entropy.
class FarField {
 public:
  /// Starts without lift. *Collective.*
  FarField(const Communicator& comm, const DualMesh& mesh, const FlowModel& model);

  /// Circulation, positive clockwise: lift per unit depth over free-stream density and speed.
  void set_circulation(double circulation) { circulation_ = circulation; }

  /// Returns the outer state at a point.
  State at(Point place) const;

 private:
  Gas gas_;
  State free_stream_;
  Point centre_;
  double circulation_ = 0;
};

}  // namespace quadloop::flow::euler
