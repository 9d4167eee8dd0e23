#include "adapt/morph/inverse_distance.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr double far_away = 30;  // radii: from there on a node's sources count as one
constexpr std::int32_t leaf_size = 4;

}  // namespace

Point InverseDistance::Follower::displacement(Point arm) const {
  return shift + Point{-versed * arm.x - sine * arm.y, sine * arm.x - versed * arm.y};
}

InverseDistance::InverseDistance(std::span<const MotionSource> sources, double reach)
    : squared_reach_{reach * reach} {
  QUADLOOP_REQUIRE(!sources.empty(), "the plane follows something");
  for (const auto& [motion, width] : sources) {
    const double half = std::sin(motion.angle / 2);
    sources_.push_back(
        {motion.from, width, 2 * half * half, std::sin(motion.angle), motion.to - motion.from});
  }
  nodes_.reserve(sources_.size());
  build(0, size32(sources_));
}

InverseDistance::Node InverseDistance::summary(std::int32_t begin, std::int32_t end) const {
  const auto part = std::span(sources_).subspan(begin, end - begin);
  Node node{{}, 0, begin, end, 0};
  Follower& mean = node.mean;
  for (const Follower& s : part) mean.width += s.width;
  for (const Follower& s : part) mean.place = mean.place + (s.width / mean.width) * s.place;
  for (const Follower& s : part) {
    const double share = s.width / mean.width;
    mean.versed += share * s.versed;
    mean.sine += share * s.sine;
    mean.shift = mean.shift + share * s.displacement(mean.place - s.place);
    node.radius = std::max(node.radius, length(s.place - mean.place));
  }
  return node;
}

void InverseDistance::build(std::int32_t begin, std::int32_t end) {
  const std::size_t self = nodes_.size();
  nodes_.push_back(summary(begin, end));
  if (end - begin > leaf_size) {
    Box box;
    for (std::int32_t s = begin; s < end; ++s) box.include(sources_[s].place);
    const bool by_x = box.width() >= box.height();
    const std::int32_t middle = begin + (end - begin) / 2;
    std::stable_sort(sources_.begin() + begin, sources_.begin() + end,
                     [&](const Follower& a, const Follower& b) {
                       return by_x ? a.place.x < b.place.x : a.place.y < b.place.y;
                     });
    build(begin, middle);
    build(middle, end);
  }
  nodes_[self].after = size32(nodes_);
}

Point InverseDistance::displacement(Point p) const {
  Point sum;
  double weights = 0;
  const auto add = [&](const Follower& source) {
    const Point arm = p - source.place;
    const double squared = dot(arm, arm);
    const double weight = source.width * (1 + squared_reach_ / squared) / (squared * std::sqrt(squared));
    weights += weight;
    sum = sum + weight * source.displacement(arm);
  };
  for (std::int32_t n = 0; n < size32(nodes_);) {
    const Node& node = nodes_[n];
    const bool is_far = length(p - node.mean.place) > far_away * node.radius;
    if (is_far) add(node.mean);
    if (!is_far && node.after == n + 1) {
      for (std::int32_t s = node.begin; s < node.end; ++s) add(sources_[s]);
    }
    n = is_far ? node.after : n + 1;
  }
  return (1 / weights) * sum;
}

}  // namespace quadloop
