#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/periodic_mesh.hpp"
#include "smoother/node/node_solver.hpp"
#include "smoother/outline/outline_path.hpp"

namespace quadloop::smoother {

/// Whether a node may move, and how.
enum class NodeFreedom : std::uint8_t { interior, sliding, fixed };

/// Moves boundary nodes along the geometry or, where the geometry has no boundary of the name, along a
/// straight mesh boundary. A node never passes its neighbours, never increases the deviation of the geometry
/// from its two chords (beyond the tolerance of cutting), and never makes a chord cross another part of the
/// geometry. On a side of a periodic pair the same holds for its partner on the other side.
class BoundarySlide {
 public:
  /// `outline` may be null, and `joined` is if `mesh` is not that of a PeriodicMesh. `pinned` flags owned
  /// nodes that stay. All arguments must outlive it. *Collective.*
  BoundarySlide(const Communicator& comm, const HaloMesh& mesh, const std::vector<BoundaryEdges>& boundaries,
                const OutlinePath* outline, const NodeFlags& pinned, const PeriodicMesh* joined = nullptr);

  /// Of an owned node.
  NodeFreedom freedom(NodeId node) const { return freedom_[node]; }

  /// A better place for a sliding node, or none: by Acceptance where the star is valid, else one that
  /// untangles. Where no corner of the star costs more than `even_up_to`, the longer edge along the boundary
  /// becomes at most 1.5 times as long as the shorter one, or no more times than it was.
  std::optional<Point> improve(NodeId node, const Star& star, Objective objective, double even_up_to);

  /// Prefetches what improve() needs for the nodes shortly after `nodes[order[k]]`.
  void fetch_ahead(std::span<const NodeId> nodes, std::span<const std::int32_t> order, std::size_t k) const;

  /// Whether a sliding node and the ways to both its neighbours lie on segments of the outline that have a
  /// height.
  bool lies_on(NodeId node, std::span<const double> heights);

  /// The height of the segment in the middle of a boundary edge; 0 where that is none of the outline.
  double height_at(const HaloEdge& edge, std::span<const double> heights);

  /// The ratio of the longer to the shorter boundary edge at a sliding node.
  double unevenness(NodeId node) const { return unevenness(rail_of(node), point(node)); }

  /// Of each node that stays where it is the lengths of the edges with a height there, that which leads to it
  /// and that which leaves it; 0 where there is none, and for nodes that slide. *Collective.*
  std::vector<Point> widths_at_fixed(std::span<const double> heights);

  /// A place nearer to the middle between a sliding node's neighbours along the outline, or none: no cell's
  /// angle may fall under 28 degrees, or under the smallest one now. Beside a node that stays it is a place
  /// nearer to the one that makes an even step to the width beyond that node, if that is smaller; `fixed` as
  /// widths_at_fixed has it.
  std::optional<Point> towards_middle(NodeId node, const Star& star, std::span<const Point> fixed);

 private:
  /// The boundary through a sliding node.
  struct Rail {
    NodeId node, before, after;
    std::int32_t boundary = -1;
  };
  /// The positions of a rail's nodes, or of their partners on the other side of a pair, with the domain to
  /// the left.
  struct Bend {
    Point before, at, after;
    std::int32_t boundary = -1;
  };
  /// The present positions of a rail's nodes on the geometry.
  struct Places {
    OutlinePlace before, at, after;
    bool valid() const { return before.valid() && at.valid() && after.valid(); }
  };
  /// Trial positions of a node, with their distances along the boundary.
  struct Steps {
    std::array<double, Star::batch> by;
    Star::Batch x, y;
    Point point(int k) const { return {x[k], y[k]}; }
  };

  void find_rails(const NodeFlags& pinned);
  void find_tight_segments(const Communicator& comm);
  bool is_tight(const Places& places) const;
  std::optional<OutlinePath::Chord> chord_of(const HaloEdge& edge);
  bool may_slide(const Rail& rail);
  bool may_slide(const Bend& bend, const Places& places) const;
  bool is_straight(const Bend& bend) const;
  Bend bend_of(const Rail& rail) const {
    return {point(rail.before), point(rail.node), point(rail.after), rail.boundary};
  }
  static Box box_round(const Bend& bend, Point p) {
    Box box = box_of(bend.before, bend.after);
    box.include(bend.at);
    box.include(p);
    return box;
  }
  const OppositeSide* opposite_of(std::int32_t boundary) const;
  Bend partner_of(const Bend& bend, const OppositeSide& opposite) const;
  bool is_outlined(std::int32_t boundary) const { return outlined_[boundary] != 0; }
  Places locate(const Rail& rail);
  Places locate(const Bend& bend) const;
  OutlinePlace place_of(NodeId node, std::int32_t boundary);
  void remember(NodeId node, Point p, std::int32_t boundary, const OutlinePath::Segments& near);
  const Point& point(NodeId node) const { return mesh_.point(node); }
  const Rail& rail_of(NodeId node) const { return nodes_[slot_[node]].rail; }
  Steps steps_along(const Rail& rail, const Places& places) const;
  double unevenness(const Rail& rail, Point p) const;
  bool keeps_even(const Rail& rail, Point to) const;
  bool keeps_outline(const Rail& rail, const Places& places, const OutlinePlace& moved, Point p);
  bool strays(const Bend& bend, const Places& places, const OutlinePlace& moved, Point p) const;
  bool keeps_clear(const Bend& bend, const Places& places, const OutlinePlace& moved, Point p,
                   const OutlinePath::Segments& near) const;
  bool partner_keeps_outline(const Bend& bend, Point p) const;

  const HaloMesh& mesh_;
  const std::vector<BoundaryEdges>& boundaries_;
  const OutlinePath* outline_;
  const PeriodicMesh* joined_;
  std::vector<char> outlined_;  ///< flags the boundaries that the geometry has
  IdVector<NodeId, NodeFreedom> freedom_;
  /// The last located point of a node and its place on the geometry, which depends on the point only.
  struct Located {
    Point point;
    OutlinePlace place;
    std::int32_t boundary = -1;
  };
  struct alignas(64) BoundaryNode {  // one cache line, as memory access dominates a visit
    Rail rail;                       ///< set where the node slides
    Located located;
  };
  IdVector<NodeId, std::int32_t> slot_;  ///< of each node at a boundary edge, in the following; else -1
  std::vector<BoundaryNode> nodes_;      ///< ascending, as they are visited
  /// Segments of the outline that a chord of another part crosses, and those that such a chord stands for:
  /// nodes there stay, as chords that keep clear of the other parts of the outline could still meet one
  /// another. Ascending.
  std::vector<std::int32_t> tight_segments_;
};

}  // namespace quadloop::smoother
