#pragma once

#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::euler {

/// The flow outside the far field: the free stream, or with the compressible point vortex that has the body's
/// lift (Thomas and Salas 1986), for a free stream slower than sound. It stands in the middle of the box of
/// the walls that feel a force. Density and pressure follow from the speed by constant total enthalpy and
/// entropy.
class FarField {
 public:
  /// Without lift. *Collective.*
  FarField(const Communicator& comm, const DualMesh& mesh, const FlowModel& model);

  /// `lift` is lift per depth over the free stream's density and speed: the circulation, clockwise above 0.
  void set_circulation(double circulation) { circulation_ = circulation; }

  /// The state outside at a place.
  State at(Point place) const;

 private:
  Gas gas_;
  State free_stream_;
  Point centre_;
  double circulation_ = 0;
};

}  // namespace quadloop::euler
