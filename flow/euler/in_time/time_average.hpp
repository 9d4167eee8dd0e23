#pragma once

#include <vector>

#include "flow/euler/model/gas.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::flow::euler {

/// Time averages of the owned nodes' states and wall friction. Forces are linear in pressure and friction, so
/// the forces of the averages are the averages of the forces.
class TimeAverage {
 public:
  /// Adds the states with the weight `duration`. `friction` may be empty.
  void add(const std::vector<State>& states, const std::vector<Point>& friction, std::size_t owned,
           double duration);

  bool empty() const { return duration_ <= 0; }
  /// Writes the averages of the states to the owned nodes.
  void take(std::vector<State>& states) const;
  std::vector<Point> friction() const;

 private:
  double duration_ = 0;
  std::vector<State> states_;  ///< times duration
  std::vector<Point> friction_;
};

}  // namespace quadloop::flow::euler
