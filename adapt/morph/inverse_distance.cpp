#include "adapt/morph/inverse_distance.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesher/base/error.hpp"

namespace quadloop::adapt {

namespace {

constexpr std::int32_t leaf_size = 4;

}  // namespace

LinearMotion& LinearMotion::operator+=(const LinearMotion& other) {
  versed += other.versed;
  sine += other.sine;
  shift = shift + other.shift;
  return *this;
}

LinearMotion operator*(double factor, const LinearMotion& motion) {
  return {factor * motion.versed, factor * motion.sine, factor * motion.shift};
}

LinearMotion linear_motion(const RigidMotion& motion) {
  const double half = std::sin(motion.angle / 2);
  return {2 * half * half, std::sin(motion.angle), motion.to - motion.from};
}

LinearMotion members_gradient(Point arm, Point g) { return {-dot(arm, g), cross(arm, g), g}; }

InverseDistance::InverseDistance(std::span<const MotionSource> sources, double reach)
    : squared_reach_{reach * reach}, sources_(sources.begin(), sources.end()), given_as_(sources.size()) {
  QUADLOOP_REQUIRE(!sources.empty(), "the plane follows something");
  std::iota(given_as_.begin(), given_as_.end(), 0);
  nodes_.reserve(sources_.size());
  build(0, size32(sources_));
  std::vector<MotionSource> sorted;
  sorted.reserve(sources_.size());
  for (const std::int32_t s : given_as_) sorted.push_back(sources_[s]);
  sources_ = std::move(sorted);
}

InverseDistance::Node InverseDistance::summary(std::int32_t begin, std::int32_t end) const {
  const auto part = std::span(given_as_).subspan(begin, end - begin);
  Node node{{}, 0, begin, end, 0};
  MotionSource& mean = node.mean;
  for (const std::int32_t s : part) mean.width += sources_[s].width;
  for (const std::int32_t s : part)
    mean.place = mean.place + (sources_[s].width / mean.width) * sources_[s].place;
  for (const std::int32_t s : part) {
    const auto& [place, width, motion] = sources_[s];
    const double share = width / mean.width;
    mean.motion.versed += share * motion.versed;
    mean.motion.sine += share * motion.sine;
    mean.motion.shift = mean.motion.shift + share * motion.displacement(mean.place - place);
    node.radius = std::max(node.radius, length(place - mean.place));
  }
  return node;
}

void InverseDistance::build(std::int32_t begin, std::int32_t end) {
  const std::size_t self = nodes_.size();
  nodes_.push_back(summary(begin, end));
  if (end - begin > leaf_size) {
    Box box;
    for (std::int32_t s = begin; s < end; ++s) box.include(sources_[given_as_[s]].place);
    const bool by_x = box.width() >= box.height();
    const std::int32_t middle = begin + (end - begin) / 2;
    std::stable_sort(given_as_.begin() + begin, given_as_.begin() + end,
                     [&](std::int32_t one, std::int32_t other) {
                       const Point a = sources_[one].place, b = sources_[other].place;
                       return by_x ? a.x < b.x : a.y < b.y;
                     });
    build(begin, middle);
    build(middle, end);
  }
  nodes_[self].after = size32(nodes_);
}

Point InverseDistance::displacement(Point p) const {
  Point sum;
  double weights = 0;
  for_each_seen(p, [&](const MotionSource& source, std::int32_t) {
    const Point arm = p - source.place;
    const double own = weight(source, arm);
    weights += own;
    sum = sum + own * source.motion.displacement(arm);
  });
  return (1 / weights) * sum;
}

std::vector<LinearMotion> InverseDistance::gradient_of_sources(std::span<const LinearMotion> of_means) const {
  std::vector<LinearMotion> gradient(sources_.size());
  for (std::size_t s = 0; s < sources_.size(); ++s) gradient[given_as_[s]] += of_means[s];
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const auto& [mean, radius, begin, end, after] = nodes_[n];
    const LinearMotion& of_mean = of_means[sources_.size() + n];
    for (std::int32_t s = begin; s < end; ++s) {
      const double share = sources_[s].width / mean.width;
      LinearMotion own = members_gradient(mean.place - sources_[s].place, of_mean.shift);
      own.versed += of_mean.versed;
      own.sine += of_mean.sine;
      gradient[given_as_[s]] += share * own;
    }
  }
  return gradient;
}

}  // namespace quadloop::adapt
