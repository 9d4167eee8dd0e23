#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/base/parallel/shared_array.hpp"
#include "mesher/geometry/boundary_conditions.hpp"
#include "mesher/geometry/curve.hpp"
#include "mesher/geometry/curve_table.hpp"
#include "mesher/geometry/layer_spec.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

class Communicator;

/// A polyline as read from a file: a closed loop (the first point is not repeated) or an open chain. The
/// domain lies to its left.
struct Chain {
  std::string name;
  bool open = false;
  std::vector<Point> points;
  std::string source;    ///< "file:line" of its header, for messages
  bool directed = true;  ///< whether the file defines the direction; drawings, maps and airfoil files do not
  /// The shapes of the segments, the closing one of a closed chain included; empty: all are straight.
  std::vector<Curve> curves = {};
  bool inner_line = false;  ///< the mesh follows it, but it bounds nothing
};

/// A boundary: its mesh settings, and its boundary condition for solvers.
struct Boundary {
  std::string name;
  double spacing = 0;          ///< requested edge length along it; 0: the spacing of the geometry's points
  double corner_degrees = 30;  ///< points with a larger turning angle become nodes; 180: none do so
  BoundaryCondition condition = {};
  /// Requested size of the quadtree cells (leaves) at its sharp corners; 0: no special size.
  double corner_spacing = 0;
  std::optional<LayerSpec> layers = {};
  std::string layers_in = {};  ///< the block in which it has layers; empty: all blocks beside it
  bool baffle = false;         ///< an inner line of which each side has nodes of its own
};

/// Requirements of single places, which override those of their boundary.
struct LocalDemands {
  std::vector<double> spacing;       ///< of each segment; positive
  std::vector<char> kept;            ///< flag of each vertex: must become a mesh node
  std::vector<double> bend_degrees;  ///< of each vertex: turning angle for spacing.curvature
};

/// The blocks of a domain, each bounded by loops of its own; without names the domain is one block.
struct LoopBlocks {
  std::vector<std::string> names;
  std::vector<std::int32_t> of_loop;  ///< index into the names
  /// Flags the segments that run against the direction of an inner line; empty: there is no inner line.
  std::vector<char> returns = {};
};

/// The geometry of the domain: simple closed loops of named boundaries that do not cross, each with the
/// domain to its left. It is the same on all ranks, and the ranks of a node may share its memory:
/// once_per_node(). Copies cost little. Segment v runs from vertex v to vertex next(v). A segment
/// with domain on both sides, between two blocks or of an inner line, is stored twice, once in each
/// direction: the two are twins. So a loop runs along an inner line and back.
class Geometry {
 public:
  /// `loop_starts` has one more entry than there are loops; loop l has the vertices loop_starts[l] ..
  /// loop_starts[l+1]-1. `segment_boundary[v]` is the boundary of segment v.
  /// `curves`: the shape of each segment; empty: all are straight. Each curve must be close to its
  /// chord, as subdivide_curves() makes it; this is not checked here.
  /// `blocks`: empty if the domain is one block.
  Geometry(std::vector<Boundary> boundaries, std::vector<Point> points, std::vector<std::int32_t> loop_starts,
           std::vector<BoundaryId> segment_boundary, std::vector<Curve> curves = {}, LoopBlocks blocks = {});

  /// Returns the geometry of the first rank, the only one that gives one. The ranks of a node share the
  /// memory of all that grows with the number of segments. *Collective.*
  static Geometry once_per_node(const Communicator& comm, std::optional<Geometry> of_first);

  /// The same geometry with other requirements at single places.
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

  /// The names of the blocks; empty if the domain is one block.
  const std::vector<std::string>& block_names() const { return block_names_; }
  bool has_blocks() const { return !block_names_.empty(); }
  /// Block to the left of a segment: 0 if the domain is one block.
  std::int32_t block_of(std::int32_t segment) const {
    return has_blocks() ? block_of_loop_[loop_of(segment)] : 0;
  }
  /// The segment with the same ends in the opposite direction; -1 if there is none.
  std::int32_t twin(std::int32_t segment) const { return twins_.empty() ? -1 : twins_[segment]; }
  bool has_twins() const { return !twins_.empty(); }
  /// Whether its boundary requests layers in the block to the left of the segment.
  bool asks_for_layers(std::int32_t segment) const {
    const Boundary& b = boundary(boundary_of(segment));
    return b.layers &&
           (b.layers_in.empty() || (has_blocks() && b.layers_in == block_names()[block_of(segment)]));
  }
  /// Whether it is the twin of the higher block, or against the direction of an inner line: decisions for
  /// both are made from the other one.
  bool is_second(std::int32_t segment) const {
    if (returns(segment)) return true;
    return twin(segment) >= 0 && block_of(segment) > block_of(twin(segment));
  }
  bool has_inner_lines() const { return !returns_.empty(); }
  /// Whether it runs against the direction of its inner line.
  bool returns(std::int32_t segment) const { return has_inner_lines() && returns_[segment] != 0; }
  /// Whether the segment has one block on both sides.
  bool is_inner_line(std::int32_t segment) const {
    return twin(segment) >= 0 && block_of(segment) == block_of(twin(segment));
  }
  /// Whether an inner line ends at the vertex: the loop turns back there.
  bool is_tip(std::int32_t v) const { return has_twins() && twin(v) == previous(v); }

  /// Whether any segment is a curve. Cells are refined and cut by the chords of the curves; then the boundary
  /// nodes move onto the curves.
  bool has_curves() const { return !curves_.empty(); }
  bool is_curved(std::int32_t segment) const { return has_curves() && !curves_.straight(segment); }
  Curve curve(std::int32_t segment) const { return has_curves() ? curves_[segment] : Curve{}; }
  CurvedSegment segment(std::int32_t s) const { return {point(s), curve(s), point(next(s))}; }
  /// The point of the segment above a point of its chord: above_chord().
  Point on_curve(std::int32_t s, Point p) const {
    return is_curved(s) ? above_chord(segment(s), p).point : p;
  }
  /// Directions of the geometry into and out of a vertex, tangents of curves; their lengths are arbitrary.
  Point direction_into(std::int32_t v) const {
    const std::int32_t s = previous(v);
    return is_curved(s) ? direction_at_end(segment(s)) : point(v) - point(s);
  }
  Point direction_out_of(std::int32_t v) const {
    return is_curved(v) ? direction_at_start(segment(v)) : point(next(v)) - point(v);
  }

  std::span<const Boundary> boundaries() const { return boundaries_; }
  const Boundary& boundary(BoundaryId b) const { return boundaries_[b.value()]; }
  std::span<const Point> points() const { return {points_.begin(), points_.end()}; }
  const Box& box() const { return box_; }

  /// Whether the vertex must become a mesh node: its turning angle exceeds its boundary's limit, or two
  /// boundaries or loops meet there.
  bool kept(std::int32_t v) const { return kept_[v] != 0; }
  /// Whether both segments at the vertex are straight, belong to one boundary and have the same direction (to
  /// straight_degrees). Straight points are ignored: inserting points into a straight segment does not change
  /// the mesh.
  bool straight(std::int32_t v) const { return (flags_[v] & is_straight) != 0; }
  static constexpr double straight_degrees = 1e-6;
  /// Turning angle of the geometry at the vertex, in degrees, 0 to 180.
  double turn_degrees(std::int32_t v) const;
  /// Turning angle of the chords at the vertex, in degrees: turn_degrees() if both segments are straight.
  double chord_turn_degrees(std::int32_t v) const;
  /// Turning angle for spacing.curvature, in degrees; 0 at kept vertices.
  double bend_degrees(std::int32_t v) const {
    return !bend_.empty() ? bend_[v] : kept(v) ? 0 : chord_turn_degrees(v);
  }
  /// The size that the segment requests of the quadtree cells which contain it: the spacing of its boundary.
  /// If that is 0: the spacing of its curve (Curve::spacing), or the length of a straight segment. Between
  /// two feature points closer than the spacing, their distance (arc length) is requested instead, so that no
  /// cell contains both.
  double spacing_of(std::int32_t segment) const;
  /// The part of the geometry between two consecutive kept vertices.
  struct Stretch {
    std::int32_t end = 0;  ///< the vertex at its end
    double length = 0;     ///< arc length
  };
  /// The stretch that begins at kept vertex v, if shorter than `limit`; none if it is longer or if the loop
  /// has no other kept vertex.
  std::optional<Stretch> stretch_shorter_than(double limit, std::int32_t v) const;

  /// The size that the vertex requests of the quadtree cells which touch it: the minimum of `corner_spacing`
  /// over those adjacent boundaries for which the vertex is a sharp corner (turning angle above
  /// `corner_degrees`); 0 if there is none.
  double corner_spacing_of(std::int32_t v) const;

  /// A hash of all coordinates, names and settings of the geometry.
  std::uint64_t digest() const;

 private:
  Geometry() = default;
  void mark_loops();
  void mark_vertices();
  void find_twins();
  struct VertexMarks;
  void keep_touching_points(VertexMarks& marks) const;
  bool is_between_twins(std::int32_t v) const;
  void shorten_spacing_between_corners();
  double spacing_of_boundary(std::int32_t segment) const;
  std::uint64_t computed_digest() const;

  std::vector<Boundary> boundaries_;
  SharedArray<Point> points_;
  SharedArray<std::int32_t> loop_starts_;
  SharedArray<BoundaryId> segment_boundary_;
  CurveTable curves_;  ///< empty: all segments are straight
  std::vector<std::string> block_names_;
  SharedArray<std::int32_t> block_of_loop_;  ///< if there are blocks
  SharedArray<char> returns_;                ///< of each segment; empty: there is no inner line
  SharedArray<std::int32_t> twins_;          ///< of each segment; empty: none has one
  SharedArray<double> spacing_;              ///< of each segment, if some differ from their boundary's
  SharedArray<double> bend_;                 ///< of each vertex, if set by LocalDemands
  SharedArray<char> kept_;
  // Bits of flags_: first and last vertex of a loop, straight.
  static constexpr std::uint8_t is_first = 1, is_last = 2, is_straight = 4;
  SharedArray<std::uint8_t> flags_;
  Box box_;
  std::optional<std::uint64_t> digest_;  ///< if known
};

/// Collects the vertices of a geometry, loop after loop.
class GeometryBuilder {
 public:
  /// Adds a vertex, with boundary and shape of the segment that begins there, and whether this runs against
  /// the direction of an inner line.
  void add(Point vertex, BoundaryId boundary, const Curve& curve = {}, bool returns = false);
  /// Adds vertex v of a geometry, with its segment.
  void add(const Geometry& geometry, std::int32_t v) {
    add(geometry.point(v), geometry.boundary_of(v), geometry.curve(v), geometry.returns(v));
  }
  /// Ends a loop, if it has vertices.
  void end_loop(std::int32_t block = 0);
  /// Adds a loop of a geometry with its block.
  void add_loop(const Geometry& geometry, std::int32_t loop);
  std::int32_t size() const { return size32(points_); }

  Geometry geometry(std::vector<Boundary> boundaries, std::vector<std::string> blocks = {}) &&;
  Geometry geometry(std::span<const Boundary> boundaries, std::vector<std::string> blocks = {}) && {
    return std::move(*this).geometry(std::vector(boundaries.begin(), boundaries.end()), std::move(blocks));
  }

 private:
  std::vector<Point> points_;
  std::vector<std::int32_t> loop_starts_{0};
  std::vector<BoundaryId> segment_boundary_;
  std::vector<Curve> curves_;
  std::vector<std::int32_t> block_of_loop_;
  std::vector<char> returns_;  ///< up to the last segment with the flag
};

/// The geometry as polylines, loop after loop: a closed chain if one boundary forms the whole loop, else one
/// open chain for each part of a boundary; the point where two chains meet is in both of them. The domain
/// lies to their left.
std::vector<Chain> chains_of(const Geometry& geometry);

}  // namespace quadloop
