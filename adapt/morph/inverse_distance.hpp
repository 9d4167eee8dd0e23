#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "adapt/morph/boundary_motion.hpp"

namespace quadloop::adapt {

/// Rigid motion of a body about one of its points, as a function linear in its members; `arm` is the position
/// relative to that point. For a rotation by a they are 1 - cos a and sin a. Its displacement is the new
/// minus the old position.
struct LinearMotion {
  double versed = 0, sine = 0;
  Point shift;

  Point displacement(Point arm) const {
    return shift + Point{-versed * arm.x - sine * arm.y, sine * arm.x - versed * arm.y};
  }
  LinearMotion& operator+=(const LinearMotion& other);
};
LinearMotion operator*(double factor, const LinearMotion& motion);

/// The motion about `motion.from`.
LinearMotion linear_motion(const RigidMotion& motion);

/// Transpose: returns the derivative of g . displacement(arm) with respect to each member of the motion.
LinearMotion members_gradient(Point arm, Point g);

/// A moving point that the surrounding plane follows.
struct MotionSource {
  Point place;
  double width = 0;  ///< length of the line that it represents
  LinearMotion motion;
};

/// The motion of the plane between moving lines: the mean of their rigid motions, weighted by width (1 +
/// (reach / r)^2) / r^3 at the distance r (Luke, Collins and Blades, J. Comput. Phys. 231, 2012). Distant
/// clusters of sources are combined. Linear in the sources' motions, so that the field of their rates is the
/// rate of the field; O(log n) per point.
class InverseDistance {
 public:
  /// `sources` must not be empty. The field depends only on the sources, their order and `reach`.
  InverseDistance(std::span<const MotionSource> sources, double reach);

  /// Returns the displacement of a point that is not a source.
  Point displacement(Point p) const;

  /// Transpose of displacement(): calls `add(number, gradient)` with the derivative of g . displacement(p)
  /// with respect to each of `mean_count()` motions, of sources or of means of several.
  template <class Add>
  void add_gradient(Point p, Point g, const Add& add) const;
  std::size_t mean_count() const { return sources_.size() + nodes_.size(); }
  /// Converts the sums from add_gradient() to gradients for each source, in the original order.
  std::vector<LinearMotion> gradient_of_sources(std::span<const LinearMotion> of_means) const;

 private:
  struct Node {
    MotionSource mean;  ///< mean of its sources, about their centre
    double radius = 0;
    std::int32_t begin = 0, end = 0;  ///< range of its sources
    std::int32_t after = 0;           ///< index of the node after its descendants
  };
  void build(std::int32_t begin, std::int32_t end);
  Node summary(std::int32_t begin, std::int32_t end) const;
  double weight(const MotionSource& source, Point arm) const {
    const double squared = dot(arm, arm);
    return source.width * (1 + squared_reach_ / squared) / (squared * std::sqrt(squared));
  }
  /// Calls `visit(source, number)` for the sources that contribute at p, or for means of distant ones.
  template <class Visit>
  void for_each_seen(Point p, const Visit& visit) const;

  // in radii: beyond this distance the sources of a node are combined
  static constexpr double far_away_ = 30;

  double squared_reach_;
  std::vector<MotionSource> sources_;
  std::vector<std::int32_t> given_as_;  ///< original number of each source
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

}  // namespace quadloop::adapt
