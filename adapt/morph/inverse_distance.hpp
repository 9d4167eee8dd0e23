#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adapt/morph/boundary_motion.hpp"

namespace quadloop {

/// A motion that the plane follows, near it most.
struct MotionSource {
  RigidMotion motion;
  double width = 0;  ///< length of the line for which it stands
};

/// The motion of the plane between lines that move: the mean of their rigid motions, weighted by width (1 +
/// (reach / r)^2) / r^3 at the distance r (Luke, Collins and Blades, J. Comput. Phys. 231, 2012). Sources
/// that lie close together are taken as one where they are seen from far away. Linear in the sources'
/// matrices and shifts; O(log n) for a place.
class InverseDistance {
 public:
  /// Not empty. What it answers depends on sources, their order and `reach` alone.
  InverseDistance(std::span<const MotionSource> sources, double reach);

  /// How far a point goes that is none of the sources' own.
  Point displacement(Point p) const;

 private:
  /// One source, or the mean of several.
  struct Follower {
    Point place;                          ///< its own, or the centre of them
    double width = 0;                     ///< of all
    double versed = 0, sine = 0;          ///< 1 - cosine and sine of the turn
    Point shift;                          ///< of `place`
    Point displacement(Point arm) const;  ///< of a point, `arm` from there
  };
  struct Node {
    Follower mean;
    double radius = 0;
    std::int32_t begin = 0, end = 0;  ///< its sources
    std::int32_t after = 0;           ///< the node behind its descendants
  };
  void build(std::int32_t begin, std::int32_t end);
  Node summary(std::int32_t begin, std::int32_t end) const;

  double squared_reach_;
  std::vector<Follower> sources_;
  std::vector<Node> nodes_;  ///< in preorder
};

}  // namespace quadloop
