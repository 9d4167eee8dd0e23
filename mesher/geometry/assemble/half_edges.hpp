#pragma once

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A planar graph as half-edges: 2 e and 2 e + 1 are the two directions of edge e. Edges share only end
/// points. Edges are added first, then link() connects them.
class HalfEdges {
 public:
  /// Adds an edge unless the graph has it. Returns the half-edge in this direction.
  std::int32_t add(Point from, Point to);
  /// Orders the half-edges round each vertex and numbers the walks round faces.
  void link();

  std::int32_t size() const { return static_cast<std::int32_t>(head_.size()); }
  std::int32_t vertices() const { return static_cast<std::int32_t>(points_.size()); }
  Point point(std::int32_t vertex) const { return points_[vertex]; }
  std::int32_t tail(std::int32_t h) const { return head_[h ^ 1]; }
  std::int32_t head(std::int32_t h) const { return head_[h]; }
  /// The next half-edge with the same tail, counter-clockwise, and the one before.
  std::int32_t after(std::int32_t h) const { return after_[h]; }
  std::int32_t before(std::int32_t h) const { return before_[h]; }
  /// The walk round the face to the left. A face with holes has several walks.
  std::int32_t walk_of(std::int32_t h) const { return walk_[h]; }
  std::int32_t walks() const { return walks_; }
  /// For each connected part a half-edge with the part's outside to its left.
  const std::vector<std::int32_t>& outermost() const { return outermost_; }

 private:
  std::int32_t vertex(Point p);
  bool comes_before(std::int32_t g, std::int32_t h) const;
  void sort_round_vertices();
  void find_outermost();
  void number_walks();

  std::vector<Point> points_;
  std::map<Point, std::int32_t> vertices_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> half_edge_;
  std::vector<std::int32_t> head_, after_, before_, walk_;
  std::vector<std::int32_t> last_of_;  ///< for each vertex the last half-edge, from straight down
  std::vector<std::int32_t> outermost_;
  std::int32_t walks_ = 0;
};

}  // namespace quadloop
