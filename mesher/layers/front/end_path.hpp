#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// The part of a boundary without layers on which the last column of a run can lie, from the wall on: its
/// first straight part; if it begins with a curve, the segments up to its first feature point, or up to a
/// turn of 30 degrees. Distances along it are those along the chords of its segments.
class EndPath {
 public:
  EndPath() = default;
  /// `wall`: the vertex where the run ends; `first`: the run begins there, so that the path leads against the
  /// direction of the loop.
  EndPath(const Geometry& geometry, std::int32_t wall, bool first);

  /// A segment of the geometry, with its farther vertex and that one's distance from the wall.
  struct Piece {
    std::int32_t segment = 0, vertex = 0;
    double distance = 0;
  };
  const std::vector<Piece>& pieces() const { return pieces_; }
  /// Whether its first segment is a curve. Otherwise the path is straight.
  bool is_curved() const { return is_curved_; }
  /// The unit direction of a curved path at the wall.
  Point direction() const { return direction_; }
  double length() const { return pieces_.empty() ? 0 : pieces_.back().distance; }

  /// A place on a curved path: the segment, and the point on it.
  struct Place {
    std::int32_t segment = 0;
    Point point;
  };
  /// The place at a distance from the wall, up to length(). That of a mirrored path is the mirrored place.
  Place place_at(double distance) const;
  Point point_at(double distance) const { return place_at(distance).point; }

 private:
  const Geometry* geometry_ = nullptr;
  bool first_ = false, is_curved_ = false;
  Point direction_;
  std::vector<Piece> pieces_;
};

}  // namespace quadloop
