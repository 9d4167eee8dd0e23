#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesher/geometry/blunt_corners.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Edges that may have become wrong where nodes moved: those opposite non-acute angles, between nodes near
/// moved ones. Excludes edges opposite right angles of unmoved halved squares: such an edge is wrong only if
/// the angle on its other side is not acute either, and is then found from the other triangle. A triangle has
/// at most one such edge, up to rounding.
class BluntEdges {
 public:
  /// The mesh must outlive it.
  BluntEdges(const Mesh& mesh, const NodeFlags& moved, const NodeFlags& near)
      : mesh_{mesh}, last_low_(mesh.points.size(), none), has_edge_(mesh.points.size(), 0) {
    for (const auto& t : mesh.triangles) {
      if (!has_edge_between(near, t)) continue;
      const bool stayed = !any_flagged(moved, t);
      unsigned blunt = blunt_corners(mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2]));
      for (; blunt != 0; blunt &= blunt - 1) {
        const auto [from, to, apex] = edge_opposite(t, std::countr_zero(blunt));
        const bool is_right = is_right_along_axes(mesh.point(from), mesh.point(apex), mesh.point(to));
        if (near[from] != 0 && near[to] != 0 && !(stayed && is_right)) add(from, to, apex);
      }
    }
  }

  /// Calls `visit(a, b, c, d)` for each such edge between two triangles a b c and b a d, for some twice. Call
  /// before for_each_single.
  template <class Visit>
  void for_each_pair(const Visit& visit) {
    for (const auto& t : mesh_.triangles) {
      if (!has_edge_between(has_edge_, t)) continue;
      for (int k = 0; k < 3; ++k) {
        const auto [from, to, apex] = edge_opposite(t, k);
        for (std::int32_t e = last_low_[std::min(from, to)]; e != none; e = edges_[e].next) {
          Edge& edge = edges_[e];
          if (edge.from != to || edge.to != from) continue;
          edge.is_single = false;
          visit(edge.from, edge.to, edge.apex, apex);
        }
      }
    }
  }

  /// Calls `visit(a, b, c)` for each such edge with only one triangle a b c on this rank.
  template <class Visit>
  void for_each_single(const Visit& visit) const {
    for (const Edge& edge : edges_) {
      if (edge.is_single) visit(edge.from, edge.to, edge.apex);
    }
  }

 private:
  static constexpr std::int32_t none = -1;
  struct Edge {
    NodeId from, to, apex;
    std::int32_t next;  ///< next edge with the same lower node
    bool is_single;
  };
  static bool has_edge_between(const NodeFlags& flags, const std::array<NodeId, 3>& t) {
    return flags[t[0]] + flags[t[1]] + flags[t[2]] > 1;
  }
  /// The ends of the edge, counter-clockwise, and the opposite node.
  static std::array<NodeId, 3> edge_opposite(const std::array<NodeId, 3>& t, int corner) {
    return {t[(corner + 1) % 3], t[(corner + 2) % 3], t[corner]};
  }
  void add(NodeId from, NodeId to, NodeId apex) {
    std::int32_t& last = last_low_[std::min(from, to)];
    edges_.push_back({from, to, apex, std::exchange(last, size32(edges_)), true});
    has_edge_[from] = has_edge_[to] = 1;
  }

  const Mesh& mesh_;
  std::vector<Edge> edges_;
  IdVector<NodeId, std::int32_t> last_low_;  ///< for each node the last edge that has it as lower end
  NodeFlags has_edge_;                       ///< flag for each node: end of such an edge
};

}  // namespace quadloop
