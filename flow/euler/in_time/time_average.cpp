#include "flow/euler/in_time/time_average.hpp"

#include <algorithm>

namespace quadloop::flow::euler {

void TimeAverage::add(const std::vector<State>& states, const std::vector<Point>& friction, std::size_t owned,
                      double duration) {
  states_.resize(owned);
  friction_.resize(std::min(friction.size(), owned));
  for (std::size_t node = 0; node < owned; ++node) {
    for (std::size_t k = 0; k < 4; ++k) states_[node][k] += duration * states[node][k];
  }
  for (std::size_t node = 0; node < friction_.size(); ++node)
    friction_[node] = friction_[node] + duration * friction[node];
  duration_ += duration;
}

void TimeAverage::take(std::vector<State>& states) const {
  for (std::size_t node = 0; node < states_.size(); ++node) {
    for (std::size_t k = 0; k < 4; ++k) states[node][k] = states_[node][k] / duration_;
  }
}

std::vector<Point> TimeAverage::friction() const {
  std::vector<Point> mean = friction_;
  for (Point& force : mean) force = (1 / duration_) * force;
  return mean;
}

}  // namespace quadloop::flow::euler
