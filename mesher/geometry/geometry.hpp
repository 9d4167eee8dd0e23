#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/layer_spec.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// One polyline as a file gives it: a closed loop (the first point is not repeated) or an open chain. The
/// domain lies to its left.
struct Chain {
  std::string name;
  bool open = false;
  std::vector<Point> points;
  std::string source;    ///< "file:line" of its header, for messages
  bool directed = true;  ///< whether its file means the direction: drawings, maps and airfoils have none
};

/// What a boundary asks of the mesh, and what a solver is told of it.
struct Boundary {
  std::string name;
  double spacing = 0;              ///< length wanted along it; 0: the geometry's own point spacing
  double corner_degrees = 30;      ///< a point that turns by more is kept as a node; 180 keeps none
  std::string condition = "none";  ///< a word of boundary_conditions
  double corner_spacing = 0;  ///< size wanted of the leaves at its sharp corners; 0: that of any other place
  std::optional<LayerSpec> layers = {};
};

/// What single places of an outline ask for, in the place of what their boundary does.
struct LocalDemands {
  std::vector<double> spacing;       ///< of each segment; above 0
  std::vector<char> kept;            ///< of each vertex: whether it must become a mesh node
  std::vector<double> bend_degrees;  ///< of each vertex: by how much the outline is taken to turn there, for
                                     ///< a rule of curvature
};

/// The outline of the domain: simple closed loops that do not meet, each walked with the domain to its left,
/// made of named boundaries. Replicated on all ranks. Vertex v is where segment v starts; it ends at next(v).
class Geometry {
 public:
  /// `loop_starts` has one entry more than there are loops; loop l owns vertices loop_starts[l] ..
  /// loop_starts[l+1]-1. `segment_boundary[v]` is the boundary of the segment from vertex v to the next one.
  Geometry(std::vector<Boundary> boundaries, std::vector<Point> points, std::vector<std::int32_t> loop_starts,
           std::vector<BoundaryId> segment_boundary);

  /// The same outline, in which single places ask for something else.
  Geometry with(LocalDemands demands) const;

  std::int32_t size() const { return size32(points_); }  ///< number of vertices, and of segments
  std::int32_t loop_count() const { return size32(loop_starts_) - 1; }
  std::int32_t loop_start(std::int32_t loop) const { return loop_starts_[loop]; }
  /// O(log l) for l loops.
  std::int32_t loop_of(std::int32_t v) const {
    return static_cast<std::int32_t>(std::ranges::upper_bound(loop_starts_, v) - loop_starts_.begin()) - 1;
  }

  Point point(std::int32_t v) const { return points_[v]; }
  std::int32_t next(std::int32_t v) const {
    return (flags_[v] & is_last) == 0 ? v + 1 : loop_starts_[loop_of(v)];
  }
  std::int32_t previous(std::int32_t v) const {
    return (flags_[v] & is_first) == 0 ? v - 1 : loop_starts_[loop_of(v) + 1] - 1;
  }
  BoundaryId boundary_of(std::int32_t segment) const { return segment_boundary_[segment]; }

  std::span<const Boundary> boundaries() const { return boundaries_; }
  const Boundary& boundary(BoundaryId b) const { return boundaries_[b.value()]; }
  std::span<const Point> points() const { return points_; }
  const Box& box() const { return box_; }

  /// Whether the vertex must become a mesh node: it turns by more than its boundary's corner, or two
  /// boundaries meet there.
  bool kept(std::int32_t v) const { return kept_[v] != 0; }
  /// Whether the outline runs straight on through the vertex (to straight_degrees) within one boundary: such
  /// a point is no feature, so a mesh does not change when segments are split.
  bool straight(std::int32_t v) const { return (flags_[v] & is_straight) != 0; }
  static constexpr double straight_degrees = 1e-6;
  /// By how much the outline turns at the vertex, in degrees, 0 to 180.
  double turn_degrees(std::int32_t v) const;
  /// By how much a smooth outline turns at the vertex, in degrees; 0 at kept ones.
  double bend_degrees(std::int32_t v) const {
    return !bend_.empty() ? bend_[v] : kept(v) ? 0 : turn_degrees(v);
  }
  /// The length that the segment asks of the leaves which hold it: its boundary's spacing, else its own
  /// length. Where the outline between two kept corners is shorter than that spacing, its whole length
  /// counts, as one cell that holds both corners is thin.
  double spacing_of(std::int32_t segment) const;
  /// A stretch of the outline between two kept vertices that follow each other.
  struct Stretch {
    std::int32_t end = 0;  ///< the vertex at its end
    double length = 0;     ///< along the outline
  };
  /// The stretch that begins with kept vertex v, if it is shorter than `limit`; none where it is not, and
  /// where the loop has no other kept vertex.
  std::optional<Stretch> stretch_shorter_than(double limit, std::int32_t v) const;

  /// The length that a sharp corner asks of the leaves which touch it: the smaller one of the boundaries that
  /// meet there and by whose `corner_degrees` the outline turns too far to be smooth. 0 at all other
  /// vertices, also where two boundaries merely meet.
  double corner_spacing_of(std::int32_t v) const;

  /// A number that changes with any coordinate, name or setting of the geometry.
  std::uint64_t digest() const;

 private:
  void keep_touching_points();
  void shorten_spacing_between_corners();
  double spacing_of_boundary(std::int32_t segment) const;

  std::vector<Boundary> boundaries_;
  std::vector<Point> points_;
  std::vector<std::int32_t> loop_starts_;
  std::vector<BoundaryId> segment_boundary_;
  std::vector<double> spacing_;  ///< of each segment, where some ask for another one than their boundary
  std::vector<double> bend_;     ///< of each vertex, where LocalDemands say so
  std::vector<char> kept_;
  static constexpr std::uint8_t is_first = 1, is_last = 2, is_straight = 4;  // of its loop; of flags_
  std::vector<std::uint8_t> flags_;
  Box box_;
};

/// The outline as polylines, loop after loop: a closed chain where one boundary goes all the way round, else
/// an open one for each stretch of a boundary, with the shared end points in both. The domain lies to their
/// left.
std::vector<Chain> chains_of(const Geometry& geometry);

}  // namespace quadloop
