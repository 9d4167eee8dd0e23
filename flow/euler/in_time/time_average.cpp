#include "flow/euler/in_time/time_average.hpp"

#include <algorithm>

namespace quadloop::flow::euler {

void TimeAverage::add(const IdVector<NodeId, State>& states, const IdVector<NodeId, Point>& friction,
                      std::size_t owned, double duration) {
  states_.resize(owned);
  friction_.resize(std::min(friction.size(), owned));
  for (const NodeId node : states_.ids()) {
    for (std::size_t k = 0; k < 4; ++k) states_[node][k] += duration * states[node][k];
  }
  for (const NodeId node : friction_.ids()) friction_[node] = friction_[node] + duration * friction[node];
  duration_ += duration;
}

void TimeAverage::take(IdVector<NodeId, State>& states) const {
  for (const NodeId node : states_.ids()) {
    for (std::size_t k = 0; k < 4; ++k) states[node][k] = states_[node][k] / duration_;
  }
}

IdVector<NodeId, Point> TimeAverage::friction() const {
  IdVector<NodeId, Point> mean = friction_;
  for (Point& force : mean) force = (1 / duration_) * force;
  return mean;
}

}  // namespace quadloop::flow::euler
