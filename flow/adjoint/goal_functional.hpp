#pragma once

#include <string>
#include <vector>

#include "flow/euler/model/goal.hpp"
#include "flow/euler/scheme/flow_run.hpp"

namespace quadloop::euler {

/// A goal of a flow without viscosity: a sum of pressures at the halves of boundary faces, each times a
/// weight. Lift and drag over all walls are wall_forces() to rounding.
class GoalFunctional {
 public:
  /// One of a boundary's faces.
  struct Part {
    std::size_t face;               ///< of the dual mesh
    double of_from = 0, of_to = 0;  ///< per pressure and length, of the halves at its two nodes
  };

  /// `boundaries` are the names of the mesh's, in its order. Throws InputError where the free stream rests,
  /// or where the goal names a boundary that there is not, or one without edges. What it is given must
  /// outlive it. *Collective.*
  GoalFunctional(const Communicator& comm, const DualMesh& mesh, const FlowModel& model,
                 const std::vector<std::string>& boundaries, const Goal& goal, double reference_length);

  /// Of states with copies. *Collective.*
  double value(const std::vector<State>& states) const;

  /// Its derivative by the states: an entry for each node, of which those of owned nodes are whole.
  std::vector<State> derivative() const;

  /// Adds to the owned nodes' sums its derivative by their places, the states being held.
  void add_place_derivative(const std::vector<State>& states, std::vector<Point>& sums) const;

  /// In the order of the mesh's faces.
  const std::vector<Part>& parts() const { return parts_; }

 private:
  const Communicator& comm_;
  const DualMesh& mesh_;
  Goal goal_;
  Point wind_;             ///< of length 1
  double scale_, length_;  ///< of coefficients; the reference length
  double outside_;         ///< the free stream's pressure
  std::vector<Part> parts_;
};

}  // namespace quadloop::euler
