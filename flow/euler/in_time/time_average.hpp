#pragma once

#include <vector>

#include "flow/euler/model/gas.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::euler {

/// The means over time of the owned nodes' states and of the friction on them. Forces are sums of pressure
/// and friction, so that those of the means are the means of the forces.
class TimeAverage {
 public:
  /// The flow at one time counts for so long. `friction` may be empty.
  void add(const std::vector<State>& states, const std::vector<Point>& friction, std::size_t owned,
           double duration);

  bool empty() const { return duration_ <= 0; }
  /// Writes the means of the states to the owned nodes.
  void take(std::vector<State>& states) const;
  std::vector<Point> friction() const;

 private:
  double duration_ = 0;
  std::vector<State> states_;  ///< times duration
  std::vector<Point> friction_;
};

}  // namespace quadloop::euler
