#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "adapt/metric/algebra/tensor.hpp"
#include "adapt/metric/tile/walls.hpp"

namespace quadloop::adapt {

/// A node of a tile with its global number; negative for a new node.
struct TileNode {
  std::int64_t id = -1;
  Point point;
  LogMetric metric;
};

/// An edge from a triangle's corner to the next: its boundary (negative: none), and whether it must not
/// change.
struct TileSide {
  std::int32_t boundary = -1;
  bool locked = false;
};

struct TileTriangle {
  std::array<std::int32_t, 3> nodes;  ///< counter-clockwise
  std::array<TileSide, 3> sides;      ///< side k runs from node k to the next
};

/// A part of a triangulation that is modified. Its border, where triangles are on other tiles, does not
/// change. Nodes and triangles keep their indices; removed ones are marked.
class TileMesh {
 public:
  enum class Freedom : char { free, slides, fixed };

  /// `walls` must outlive it.
  TileMesh(const std::vector<TileNode>& nodes, std::vector<TileTriangle> triangles, const Walls& walls);

  std::int32_t nodes() const { return static_cast<std::int32_t>(nodes_.size()); }
  std::int32_t triangles() const { return static_cast<std::int32_t>(triangles_.size()); }
  const TileTriangle& triangle(std::int32_t t) const { return triangles_[t]; }
  bool stands(std::int32_t t) const { return standing_[t] != 0; }
  const TileNode& node(std::int32_t n) const { return nodes_[n]; }
  Point point(std::int32_t n) const { return nodes_[n].point; }
  const Metric& metric(std::int32_t n) const { return metrics_[n]; }
  Freedom freedom(std::int32_t n) const { return freedom_[n]; }
  /// The triangles around a node; empty for a removed node.
  const std::vector<std::int32_t>& star(std::int32_t n) const { return stars_[n]; }
  const Walls& walls() const { return walls_; }

  double edge_length(std::int32_t a, std::int32_t b) const {
    return length_between(metrics_[a], metrics_[b], point(b) - point(a));
  }
  /// Quality in the mean metric of three nodes, with the nodes at these positions.
  double quality(const std::array<std::int32_t, 3>& nodes, const std::array<Point, 3>& at) const;
  double quality(const std::array<std::int32_t, 3>& nodes) const {
    return quality(nodes, {point(nodes[0]), point(nodes[1]), point(nodes[2])});
  }
  double quality(std::int32_t t) const { return quality(triangles_[t].nodes); }
  /// The smallest quality in a node's star.
  double worst_round(std::int32_t n) const;

  /// An edge with its adjacent triangles: `left` has it from a to b. Negative: there is none.
  struct Edge {
    std::int32_t a = -1, b = -1, left = -1, right = -1;
    TileSide side;
  };
  std::optional<Edge> edge(std::int32_t a, std::int32_t b) const;
  /// Each edge once, in the order of triangles.
  std::vector<std::array<std::int32_t, 2>> edges() const;
  /// The chord of the geometry for the edge from a to b.
  Walls::Chord chord(std::int32_t a, std::int32_t b, std::int32_t boundary) const;
  /// The neighbours of a sliding node along its boundary: previous, next.
  std::array<std::int32_t, 2> neighbours_on_wall(std::int32_t n) const;
  std::int32_t boundary_of(std::int32_t n) const { return boundaries_[n]; }
  std::vector<std::int32_t> neighbours(std::int32_t n) const;

  std::int32_t add_node(Point p, const LogMetric& metric, Freedom freedom, std::int32_t boundary);
  void move_node(std::int32_t n, Point p, const LogMetric& metric);
  void add_triangle(const TileTriangle& triangle);
  void remove_triangle(std::int32_t t);
  /// Replaces one node of a triangle by another.
  void replace_node(std::int32_t t, std::int32_t from, std::int32_t to);

  void set_side(std::int32_t a, std::int32_t b, const TileSide& side);

  /// The index of a node in a triangle; negative if it is not a node of the triangle.
  int corner(std::int32_t t, std::int32_t n) const;

 private:
  void lock_rim();
  void lock_walls();
  void set_freedom(std::int32_t n);

  const Walls& walls_;
  std::vector<TileNode> nodes_;
  std::vector<Metric> metrics_;
  std::vector<Freedom> freedom_;
  std::vector<std::int32_t> boundaries_;  ///< of sliding nodes
  std::vector<std::vector<std::int32_t>> stars_;
  std::vector<TileTriangle> triangles_;
  std::vector<char> standing_;
};

}  // namespace quadloop::adapt
