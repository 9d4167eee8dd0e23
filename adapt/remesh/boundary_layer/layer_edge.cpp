#include "adapt/remesh/boundary_layer/layer_edge.hpp"

#include <algorithm>
#include <cmath>

namespace quadloop::adapt {

namespace {

constexpr double decayed = 0.2;         // of the maximum
constexpr double least_maximum = 0.03;  // of the velocity at the edge

}  // namespace

std::optional<double> layer_edge(std::span<const ProfileSample> profile) {
  if (profile.empty()) return {};
  const double forward = profile.front().velocity < 0 ? -1 : 1;
  double largest = 0, before = 0;
  for (std::size_t k = 0; k < profile.size(); ++k) {
    const auto& [height, velocity, shear] = profile[k];
    const double function = height * forward * shear;
    if (!std::isfinite(function) || !(forward * velocity >= 0)) return {};
    if (largest > 0 && function <= decayed * largest) {
      if (largest < least_maximum * std::abs(velocity)) return {};
      const double share = (before - decayed * largest) / (before - function);
      return profile[k - 1].height + share * (height - profile[k - 1].height);
    }
    largest = std::max(largest, function);
    before = function;
  }
  return {};
}

}  // namespace quadloop::adapt
