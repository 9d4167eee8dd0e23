#include "mesher/build/make_delaunay.hpp"

#include <algorithm>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/delaunay/restore/restore_delaunay.hpp"
#include "mesher/forest/ghost_exchange.hpp"
#include "mesher/mesh/node_table.hpp"

namespace quadloop {

namespace {

/// The nodes of the cells of cut leaves and of those with a snapped corner: both ends of any edge between
/// cells that may not be Delaunay, those without squares' diagonals.
std::vector<GlobalNodeId> nodes_of_cut_leaves(const CutForest& cut, const Mesh& mesh,
                                              const std::vector<LeafRecord>& leaves) {
  std::vector<GlobalNodeId> nodes;
  NodeFlags named(mesh.points.size(), 0);
  auto triangle = mesh.triangles.cbegin();
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    const auto end = triangle + leaves[i].triangles;
    if (cut.entry_of[i] < 0) triangle = end;
    for (; triangle != end; ++triangle) {
      for (const NodeId node : *triangle) {
        if (std::exchange(named[node], 1) == 0) nodes.push_back(mesh.global(node));
      }
    }
  }
  return nodes;
}

/// Flags the local leaves that are cut or have a snapped corner, and all around such leaves. *Collective.*
std::vector<char> irregular_leaves(const Communicator& comm, const LeafGraph& graph, const CutForest& cut) {
  std::vector<char> is_cut(graph.size(), 0);
  for (std::int32_t i = 0; i < std::ssize(cut.entry_of); ++i) {
    is_cut[graph.from_local(i).value()] = cut.entry_of[i] >= 0 ? 1 : 0;
  }
  GhostExchange(comm, graph).update(is_cut);
  std::vector<char> irregular = is_cut;
  LeafFinder finder(graph);
  for (const LeafId leaf : graph.all()) {
    if (is_cut[leaf.value()] == 0) continue;
    for_touching_leaves(finder, leaf, [&](LeafId other) { irregular[other.value()] = 1; });
  }
  const auto first = irregular.begin() + graph.local_begin();
  return {first, first + graph.local_size()};
}

using GlobalNodes = std::array<GlobalNodeId, 3>;

/// A triangle on the way to the rank of its leaf.
struct FreeTriangle {
  GlobalNodes nodes;
  std::array<Point, 3> points;
};

/// A triangle in its leaf.
struct PlacedTriangle {
  std::int32_t leaf = 0;     ///< its local index
  GlobalNodes global_nodes;  ///< the smallest first
  std::array<NodeId, 3> nodes;
  friend auto operator<=>(const PlacedTriangle&, const PlacedTriangle&) = default;
};

/// The triangles of irregular leaves go to the leaves that hold their centroids, where most stand already.
class LeafTriangles {
 public:
  LeafTriangles(const Lattice& lattice, const LeafGraph& graph, Mesh& mesh)
      : lattice_{lattice}, graph_{graph}, finder_{graph}, mesh_{mesh} {}

  /// *Collective.*
  void share_out(const Communicator& comm, const std::vector<char>& irregular,
                 const std::vector<LeafRecord>& leaves) {
    std::int32_t triangle = 0;
    for (std::int32_t i = 0; i < std::ssize(leaves); ++i) {
      const std::int32_t end = triangle + leaves[i].triangles;
      if (irregular[i] != 0) send_strangers(graph_.from_local(i), triangle, end);
      triangle = end;
    }
    NodeTable table(mesh_);
    for (const FreeTriangle& t : on_their_way_.deliver(comm)) {
      const Point p = centroid(t.points);
      const LeafId leaf = finder_.leaf_at(lattice_.column_at(p.x), lattice_.row_at(p.y));
      PlacedTriangle placed{graph_.local_index(leaf), t.nodes, {}};
      for (std::size_t k = 0; k < 3; ++k) placed.nodes[k] = table.local(t.nodes[k], t.points[k]);
      arrived_.push_back(placed);
    }
    std::sort(arrived_.begin(), arrived_.end());
  }

  /// Puts them there. In irregular leaves all are sorted by the numbers of their nodes.
  void put_back(const std::vector<char>& irregular, std::vector<LeafRecord>& leaves) const {
    const auto before = std::exchange(mesh_.triangles, {});
    mesh_.triangles.reserve(before.size());
    auto arrival = arrived_.cbegin();
    auto stranger = strangers_.cbegin();
    std::vector<PlacedTriangle> here;
    std::int32_t triangle = 0;
    for (std::int32_t i = 0; i < std::ssize(leaves); ++i) {
      const std::int32_t begin = size32(mesh_.triangles), end = triangle + leaves[i].triangles;
      here.clear();
      if (irregular[i] == 0)
        mesh_.triangles.insert(mesh_.triangles.end(), before.begin() + triangle, before.begin() + end);
      for (std::int32_t t = triangle; t < end && irregular[i] != 0; ++t) {
        if (stranger != strangers_.end() && *stranger == t) {
          ++stranger;
        } else {
          here.push_back(placed(i, before[t]));
        }
      }
      triangle = end;
      for (; arrival != arrived_.end() && arrival->leaf == i; ++arrival) here.push_back(*arrival);
      std::sort(here.begin(), here.end());
      for (const PlacedTriangle& t : here) mesh_.triangles.push_back(t.nodes);
      leaves[i].triangles = size32(mesh_.triangles) - begin;
      leaves[i].block = leaves[i].triangles > 0 ? 1 : 0;
    }
    QUADLOOP_REQUIRE(arrival == arrived_.end(), "the centroid of each triangle lies in a leaf");
  }

 private:
  /// Sends those of a leaf's triangles, from one to another, whose centroids lie in other leaves.
  void send_strangers(LeafId leaf, std::int32_t begin, std::int32_t end) {
    const Box box = lattice_.box_of(graph_.leaf(leaf));
    for (std::int32_t t = begin; t < end; ++t) {
      const std::array<NodeId, 3>& nodes = mesh_.triangles[t];
      const Point p = centroid({mesh_.point(nodes[0]), mesh_.point(nodes[1]), mesh_.point(nodes[2])});
      if (box.low.x <= p.x && p.x < box.high.x && box.low.y <= p.y && p.y < box.high.y) continue;
      const std::int64_t column = lattice_.column_at(p.x), row = lattice_.row_at(p.y);
      const LeafId home = finder_.leaf_at(column, row);
      if (home == leaf) continue;
      strangers_.push_back(t);
      const PlacedTriangle stranger = placed(graph_.local_index(home), nodes);
      if (graph_.is_local(home)) {
        arrived_.push_back(stranger);
      } else {
        FreeTriangle free{stranger.global_nodes, {}};
        for (std::size_t k = 0; k < 3; ++k) free.points[k] = mesh_.point(stranger.nodes[k]);
        on_their_way_.add(graph_.rank_at(column, row), free);
      }
    }
  }

  PlacedTriangle placed(std::int32_t leaf, std::array<NodeId, 3> nodes) const {
    const auto before = [&](NodeId a, NodeId b) { return mesh_.global(a) < mesh_.global(b); };
    std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end(), before), nodes.end());
    return {leaf, {mesh_.global(nodes[0]), mesh_.global(nodes[1]), mesh_.global(nodes[2])}, nodes};
  }

  /// The nodes are added up in the order of their coordinates, for the same sum on every rank.
  static Point centroid(std::array<Point, 3> p) {
    std::sort(p.begin(), p.end());
    return {(p[0].x + p[1].x + p[2].x) / 3, (p[0].y + p[1].y + p[2].y) / 3};
  }

  const Lattice& lattice_;
  const LeafGraph& graph_;
  LeafFinder finder_;
  Mesh& mesh_;
  std::vector<std::int32_t> strangers_;  ///< triangles of the mesh that leave their leaves, ascending
  std::vector<PlacedTriangle> arrived_;
  Outbox<FreeTriangle> on_their_way_;
};

}  // namespace

void make_delaunay(const Communicator& comm, const Lattice& lattice,
                   const std::function<TieRank(Point)>& rank_of, const LeafGraph& graph, const CutForest& cut,
                   Mesh& mesh, std::vector<LeafRecord>& leaves) {
  restore_delaunay_at(comm, mesh, nodes_of_cut_leaves(cut, mesh, leaves), rank_of);
  const std::vector<char> irregular = irregular_leaves(comm, graph, cut);
  LeafTriangles triangles(lattice, graph, mesh);
  triangles.share_out(comm, irregular, leaves);
  triangles.put_back(irregular, leaves);
}

}  // namespace quadloop
