#pragma once

#include <string>
#include <vector>

#include "flow/euler/model/goal.hpp"
#include "flow/euler/scheme/flow_run.hpp"

namespace quadloop::flow::euler {

/// An output functional of inviscid flow: a weighted sum of pressures at the halves of boundary faces. Lift
/// and drag over all walls equal wall_forces() up to rounding.
class GoalFunctional {
 public:
  /// One face of a boundary.
  struct Part {
    std::size_t face;               ///< index in the dual mesh
    double of_from = 0, of_to = 0;  ///< weights per pressure and length of the halves at its two nodes
  };

  /// `boundaries` are the names of the mesh's boundaries, in its order. The arguments must outlive the
  /// object. Throws InputError if the free stream is at rest, or if the functional names an unknown boundary
  /// or one without edges. *Collective.*
  GoalFunctional(const Communicator& comm, const DualMesh& mesh, const FlowModel& model,
                 const std::vector<std::string>& boundaries, const Goal& goal, double reference_length);

  /// Ghosts of the states must be up to date. *Collective.*
  double value(const IdVector<NodeId, State>& states) const;

  /// Returns the derivative with respect to the states: an entry for each node, complete for owned nodes.
  IdVector<NodeId, State> derivative() const;

  /// Adds to the owned nodes' sums the derivative with respect to their positions at constant states.
  void add_place_derivative(const IdVector<NodeId, State>& states, IdVector<NodeId, Point>& sums) const;

  /// In the order of the mesh's faces.
  const std::vector<Part>& parts() const { return parts_; }

 private:
  const Communicator& comm_;
  const DualMesh& mesh_;
  Goal goal_;
  Point wind_;             ///< unit vector
  double scale_, length_;  ///< of the coefficients; the reference length
  double outside_;         ///< free-stream pressure
  std::vector<Part> parts_;
};

}  // namespace quadloop::flow::euler
