#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesher/delaunay/flipper.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Edges that may have become wrong where nodes moved: opposite angles that are not acute, between nodes near
/// moved ones. Those of right angles in halved squares that stayed are left out: such an edge is wrong only
/// if the angle opposite it on the other side is not acute either, and then that one's triangle has it. No
/// triangle has more than one, but for rounding.
class BluntEdges {
 public:
  /// Mesh and `near` must outlive it.
  BluntEdges(const Mesh& mesh, const NodeFlags& moved, const NodeFlags& near)
      : mesh_{mesh}, near_{near}, last_low_(mesh.points.size(), none) {
    for (const auto& t : mesh.triangles) {
      if (!has_edge_near(t)) continue;
      const bool stayed = !any_flagged(moved, t);
      for_each_edge(t, [&](NodeId from, NodeId to, NodeId apex) {
        const Point a = mesh.point(from), p = mesh.point(apex), b = mesh.point(to);
        if (near[from] == 0 || near[to] == 0 || surely_acute(a, p, b) ||
            (stayed && is_right_along_axes(a, p, b)))
          return;
        std::int32_t& last = last_low_[std::min(from, to)];
        edges_.push_back({from, to, apex, std::exchange(last, size32(edges_)), true});
      });
    }
  }

  /// Calls `visit(a, b, c, d)` for those between two triangles a b c and b a d, for some twice. To be called
  /// before for_each_single.
  template <class Visit>
  void for_each_pair(const Visit& visit) {
    for (const auto& t : mesh_.triangles) {
      if (!has_edge_near(t)) continue;
      for_each_edge(t, [&](NodeId from, NodeId to, NodeId apex) {
        for (std::int32_t e = last_low_[std::min(from, to)]; e != none; e = edges_[e].next) {
          Edge& edge = edges_[e];
          if (edge.from != to || edge.to != from) continue;
          edge.is_single = false;
          visit(edge.from, edge.to, edge.apex, apex);
        }
      });
    }
  }

  /// Calls `visit(a, b, c)` for those of one triangle a b c on this rank.
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
    std::int32_t next;  ///< of the same lower node
    bool is_single;
  };
  bool has_edge_near(const std::array<NodeId, 3>& t) const {
    return near_[t[0]] + near_[t[1]] + near_[t[2]] > 1;
  }
  template <class Visit>
  static void for_each_edge(const std::array<NodeId, 3>& t, const Visit& visit) {
    for (std::size_t k = 0; k < 3; ++k) visit(t[(k + 1) % 3], t[(k + 2) % 3], t[k]);
  }

  const Mesh& mesh_;
  const NodeFlags& near_;
  std::vector<Edge> edges_;
  IdVector<NodeId, std::int32_t> last_low_;  ///< of each node, the last edge with it as the lower end
};

}  // namespace quadloop
