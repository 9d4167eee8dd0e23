#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/node_table.hpp"

namespace quadloop {

struct PeriodicMesh;

/// A boundary edge with the domain to its left.
struct HaloEdge {
  NodeId from, to;
  std::int32_t boundary = -1;
};

/// One rank's part of a mesh with all cells, including those of other ranks, that touch its owned nodes.
/// Cells are in their global order, so sums over the cells around a node do not depend on the partition.
class HaloMesh {
 public:
  /// `mesh` must outlive the object, with unchanged cells. *Collective.*
  HaloMesh(const Communicator& comm, const Mesh& mesh);
  /// Around each node also the cells on the other sides of periodic pairs, moved to where the node is; their
  /// other nodes are images, which are ghosts. These cells come after the others of their kind, in global
  /// order. `joined` must outlive the object, with unchanged cells. *Collective.*
  HaloMesh(const Communicator& comm, const PeriodicMesh& joined);

  /// The owned nodes and the ghosts of the mesh, in its order, then the remaining nodes of the cells of other
  /// ranks.
  std::vector<Point>& points() { return points_; }
  const std::vector<Point>& points() const { return points_; }
  const Point& point(NodeId node) const { return points_[node.value()]; }
  std::int32_t owned_nodes() const { return mesh_->owned_nodes; }
  bool owns(NodeId node) const { return mesh_->owns(node); }
  /// Of an image the number of its original.
  GlobalNodeId global(NodeId node) const {
    return joined_ == nullptr ? image(node) : number_of_original(node);
  }
  /// The image_number() of a node.
  GlobalNodeId image(NodeId node) const {
    return owns(node) ? mesh_->global(node) : ghosts_[node.value() - owned_nodes()];
  }
  const NodeExchange& exchange() const { return exchange_; }
  /// Where a node is if its original is at this position.
  Point place(NodeId node, Point original) const {
    return joined_ == nullptr ? original : place(image(node), original);
  }
  /// Sets the positions of ghosts to those of their owners, or to their images. *Collective.*
  void update_points();

  /// Contains every boundary edge at an owned node, and some more. This rank's edges come first; the edges
  /// are not in global order.
  const std::vector<HaloEdge>& boundary_edges() const { return edges_; }
  /// Those that were not moved to the other side of a pair. Edges on the sides of pairs never are.
  std::span<const HaloEdge> edges_in_place() const { return std::span(edges_).first(in_place_); }

  /// `own` has a value for each cell of this rank's Mesh, triangles first, then quads. Returns the values of
  /// all cells of the HaloMesh, in the order of for_each_cell(). *Collective.*
  template <class T>
  std::vector<T> spread(const Communicator& comm, const std::vector<T>& own) const;

  bool has_quads() const {
    return !(quads_before_.empty() && mesh_->quads.empty() && quads_after_.empty() && quads_moved_.empty());
  }

  /// Number of cells that for_each_cell() visits.
  std::size_t cell_count() const {
    return triangles_before_.size() + mesh_->triangles.size() + triangles_after_.size() +
           triangles_moved_.size() + quads_before_.size() + mesh_->quads.size() + quads_after_.size() +
           quads_moved_.size();
  }

  /// Calls `visit(nodes)` for each cell, with an array of three or four nodes: triangles, then quads.
  template <class Visit>
  void for_each_cell(const Visit& visit) const {
    for (const auto* part : {&triangles_before_, &mesh_->triangles, &triangles_after_, &triangles_moved_}) {
      for (const auto& nodes : *part) visit(nodes);
    }
    for (const auto* part : {&quads_before_, &mesh_->quads, &quads_after_, &quads_moved_}) {
      for (const auto& nodes : *part) visit(nodes);
    }
  }

 private:
  template <std::size_t width>
  using Cells = std::vector<std::array<NodeId, width>>;

  /// Own cells that other ranks also need, each with that rank.
  struct Sent {
    std::vector<std::int32_t> cells;
    std::vector<int> ranks;

    void add(std::int32_t cell, int rank) {
      cells.push_back(cell);
      ranks.push_back(rank);
    }
    template <class T>
    std::vector<T> deliver(const Communicator& comm, std::span<const T> own) const {
      std::vector<T> out;
      for (const std::int32_t cell : cells) out.push_back(own[cell]);
      return Exchange(comm, ranks).deliver(out);
    }
  };
  struct SentOfKind {
    Sent in_place, moved;  ///< to where they are, and to the other sides of pairs
  };
  template <std::size_t width>
  struct CellsOfOthers {
    Cells<width>&before, &after, &moved;
  };
  HaloMesh(const Communicator& comm, const Mesh& mesh, const PeriodicMesh* joined);
  NodeExchange gather(const Communicator& comm);
  Point original(NodeId node) const;
  GlobalNodeId number_of_original(NodeId node) const;
  Point place(GlobalNodeId image, Point original) const;
  template <std::size_t width>
  void receive_cells(const Communicator& comm, const NodeOwners& owners, const Cells<width>& own,
                     NodeTable& nodes, const CellsOfOthers<width>& received, SentOfKind& sent);
  void receive_edges(const Communicator& comm, const NodeOwners& owners, const NodeTable& nodes);
  template <class T>
  void append_spread(const Communicator& comm, const SentOfKind& sent, std::size_t before,
                     std::span<const T> own, std::vector<T>& all) const;

  const Mesh* mesh_;
  const PeriodicMesh* joined_;  ///< null if no pairs are joined
  std::vector<Point> points_;
  std::vector<GlobalNodeId> ghosts_;             ///< as image_number()
  Cells<3> triangles_before_, triangles_after_;  ///< of lower and of higher ranks
  Cells<4> quads_before_, quads_after_;
  Cells<3> triangles_moved_;  ///< of the other sides of pairs
  Cells<4> quads_moved_;
  std::vector<HaloEdge> edges_;  ///< those in place come first
  std::size_t in_place_ = 0;     ///< number of these
  SentOfKind triangles_sent_, quads_sent_;
  NodeExchange exchange_;
};

template <class T>
void HaloMesh::append_spread(const Communicator& comm, const SentOfKind& sent, std::size_t before,
                             std::span<const T> own, std::vector<T>& all) const {
  const std::vector<T> others = sent.in_place.deliver(comm, own);
  const auto middle = others.begin() + static_cast<std::ptrdiff_t>(before);
  all.insert(all.end(), others.begin(), middle);
  all.insert(all.end(), own.begin(), own.end());
  all.insert(all.end(), middle, others.end());
  if (joined_ == nullptr) return;
  const std::vector<T> moved = sent.moved.deliver(comm, own);
  all.insert(all.end(), moved.begin(), moved.end());
}

template <class T>
std::vector<T> HaloMesh::spread(const Communicator& comm, const std::vector<T>& own) const {
  std::vector<T> all;
  all.reserve(cell_count());
  const std::size_t triangles = mesh_->triangles.size();
  append_spread(comm, triangles_sent_, triangles_before_.size(), std::span(own).first(triangles), all);
  append_spread(comm, quads_sent_, quads_before_.size(), std::span(own).subspan(triangles), all);
  return all;
}

}  // namespace quadloop
