#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "adapt/morph/boundary_motion.hpp"

namespace quadloop {

/// How a body moves about one of its points, `arm` from there: linear in its members. That of a turn by a has
/// 1 - cos a and sin a, and what it does less where it is.
struct LinearMotion {
  double versed = 0, sine = 0;
  Point shift;

  Point displacement(Point arm) const {
    return shift + Point{-versed * arm.x - sine * arm.y, sine * arm.x - versed * arm.y};
  }
  LinearMotion& operator+=(const LinearMotion& other);
};
LinearMotion operator*(double factor, const LinearMotion& motion);

/// About `motion.from`.
LinearMotion linear_motion(const RigidMotion& motion);

/// By how much a sum of g . displacement(arm) changes with each member of the motion. The transpose.
LinearMotion members_gradient(Point arm, Point g);

/// A motion that the plane follows, near its place most.
struct MotionSource {
  Point place;
  double width = 0;  ///< length of the line for which it stands
  LinearMotion motion;
};

/// The motion of the plane between lines that move: the mean of their rigid motions, weighted by width (1 +
/// (reach / r)^2) / r^3 at the distance r (Luke, Collins and Blades, J. Comput. Phys. 231, 2012). Sources
/// that lie close together are taken as one where they are seen from far away. Linear in the sources'
/// motions, so that the field of their rates is the rate of the field; O(log n) for a place.
class InverseDistance {
 public:
  /// Not empty. What it answers depends on sources, their order and `reach` alone.
  InverseDistance(std::span<const MotionSource> sources, double reach);

  /// How far a point goes that is none of the sources' own.
  Point displacement(Point p) const;

  /// The transpose of displacement(): adds to what a sum of g . displacement(p) over points gains from each
  /// of `mean_count()` motions, of sources or of means of several, by calling `add(number, gradient)`.
  template <class Add>
  void add_gradient(Point p, Point g, const Add& add) const;
  std::size_t mean_count() const { return sources_.size() + nodes_.size(); }
  /// From the sums that add_gradient() told of to those for each source, in the order that they were given.
  std::vector<LinearMotion> gradient_of_sources(std::span<const LinearMotion> of_means) const;

 private:
  struct Node {
    MotionSource mean;  ///< of its sources, about the centre of them
    double radius = 0;
    std::int32_t begin = 0, end = 0;  ///< its sources
    std::int32_t after = 0;           ///< the node behind its descendants
  };
  void build(std::int32_t begin, std::int32_t end);
  Node summary(std::int32_t begin, std::int32_t end) const;
  double weight(const MotionSource& source, Point arm) const {
    const double squared = dot(arm, arm);
    return source.width * (1 + squared_reach_ / squared) / (squared * std::sqrt(squared));
  }
  /// Calls `visit(source, number)` for those that count at p: sources, or means where they are far away.
  template <class Visit>
  void for_each_seen(Point p, const Visit& visit) const;

  static constexpr double far_away_ = 30;  // radii: from there on a node's sources count as one

  double squared_reach_;
  std::vector<MotionSource> sources_;
  std::vector<std::int32_t> given_as_;  ///< the number that each source was given as
  std::vector<Node> nodes_;             ///< in preorder
};

template <class Visit>
void InverseDistance::for_each_seen(Point p, const Visit& visit) const {
  const std::int32_t sources = size32(sources_);
  for (std::int32_t n = 0; n < size32(nodes_);) {
    const Node& node = nodes_[n];
    const bool is_far = length(p - node.mean.place) > far_away_ * node.radius;
    if (is_far) visit(node.mean, sources + n);
    if (!is_far && node.after == n + 1) {
      for (std::int32_t s = node.begin; s < node.end; ++s) visit(sources_[s], s);
    }
    n = is_far ? node.after : n + 1;
  }
}

template <class Add>
void InverseDistance::add_gradient(Point p, Point g, const Add& add) const {
  double weights = 0;
  for_each_seen(
      p, [&](const MotionSource& source, std::int32_t) { weights += weight(source, p - source.place); });
  for_each_seen(p, [&](const MotionSource& source, std::int32_t number) {
    const Point arm = p - source.place;
    add(number, members_gradient(arm, (weight(source, arm) / weights) * g));
  });
}

}  // namespace quadloop
