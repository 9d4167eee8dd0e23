#pragma once

#include "flow/euler/model/gas.hpp"
#include "mesher/base/id_vector.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::flow::euler {

/// Time averages of the owned nodes' states and wall friction. Forces are linear in pressure and friction, so
/// the forces of the averages are the averages of the forces.
class TimeAverage {
 public:
  /// Adds the states with the weight `duration`. `friction` may be empty.
  void add(const IdVector<NodeId, State>& states, const IdVector<NodeId, Point>& friction, std::size_t owned,
           double duration);

  bool empty() const { return duration_ <= 0; }
  /// Writes the averages of the states to the owned nodes.
  void take(IdVector<NodeId, State>& states) const;
  IdVector<NodeId, Point> friction() const;

 private:
  double duration_ = 0;
  IdVector<NodeId, State> states_;  ///< times duration
  IdVector<NodeId, Point> friction_;
};

}  // namespace quadloop::flow::euler
