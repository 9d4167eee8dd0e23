#include "mesher/build/make_delaunay.hpp"

#include <algorithm>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/build/split_quads.hpp"
#include "mesher/delaunay/restore/restore_delaunay.hpp"
#include "mesher/forest/ghost_exchange.hpp"
#include "mesher/mesh/node_table.hpp"

namespace quadloop {

namespace {

/// Of the diagonals of a leaf's square the one through the corner that it shares with its parent, whose
/// coordinates have the most trailing zeros.
Diagonal diagonal_of(const Quadrant& q) {
  const bool rising = ((q.x & q.size()) != 0) == ((q.y & q.size()) != 0);
  return rising ? Diagonal::first : Diagonal::second;
}

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

/// A triangle that has arrived.
struct PlacedTriangle {
  std::int32_t leaf = 0;     ///< its local index
  GlobalNodes global_nodes;  ///< the smallest first
  std::array<NodeId, 3> nodes;
  friend auto operator<=>(const PlacedTriangle&, const PlacedTriangle&) = default;
};

/// The triangles of irregular leaves go to the leaves that hold their centroids.
class LeafTriangles {
 public:
  LeafTriangles(const Lattice& lattice, const LeafGraph& graph, Mesh& mesh)
      : lattice_{lattice}, graph_{graph}, finder_{graph}, mesh_{mesh} {}

  /// *Collective.*
  void share_out(const Communicator& comm, const std::vector<char>& irregular,
                 const std::vector<LeafRecord>& leaves) {
    auto triangle = mesh_.triangles.cbegin();
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const auto end = triangle + leaves[i].triangles;
      const LeafId leaf = graph_.from_local(static_cast<std::int32_t>(i));
      if (irregular[i] != 0) std::for_each(triangle, end, [&](const auto& nodes) { place(nodes, leaf); });
      triangle = end;
    }
    NodeTable table(mesh_);
    for (const FreeTriangle& t : on_their_way_.deliver(comm)) {
      const auto [column, row] = square_of(t.points);
      PlacedTriangle placed{graph_.local_index(finder_.leaf_at(column, row)), t.nodes, {}};
      for (std::size_t k = 0; k < 3; ++k) placed.nodes[k] = table.local(t.nodes[k], t.points[k]);
      placed_.push_back(placed);
    }
    std::sort(placed_.begin(), placed_.end());
  }

  /// Puts them there, sorted by the numbers of their nodes; those of other leaves stay.
  void put_back(const std::vector<char>& irregular, std::vector<LeafRecord>& leaves) const {
    const auto before = std::exchange(mesh_.triangles, {});
    mesh_.triangles.reserve(before.size());
    auto stays = before.cbegin();
    auto placed = placed_.cbegin();
    for (std::int32_t i = 0; i < std::ssize(leaves); ++i) {
      const std::int32_t begin = size32(mesh_.triangles);
      const auto end = stays + leaves[i].triangles;
      if (irregular[i] == 0) mesh_.triangles.insert(mesh_.triangles.end(), stays, end);
      stays = end;
      for (; placed != placed_.end() && placed->leaf == i; ++placed) mesh_.triangles.push_back(placed->nodes);
      leaves[i].triangles = size32(mesh_.triangles) - begin;
      leaves[i].block = leaves[i].triangles > 0 ? 1 : 0;
    }
    QUADLOOP_REQUIRE(placed == placed_.end(), "the centroid of each triangle lies in a leaf");
  }

 private:
  /// Most stand in the slots of their leaves already.
  void place(std::array<NodeId, 3> nodes, LeafId slot) {
    const auto before = [&](NodeId a, NodeId b) { return mesh_.global(a) < mesh_.global(b); };
    std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end(), before), nodes.end());
    FreeTriangle t;
    for (std::size_t k = 0; k < 3; ++k) {
      t.nodes[k] = mesh_.global(nodes[k]);
      t.points[k] = mesh_.point(nodes[k]);
    }
    const auto [column, row] = square_of(t.points);
    const LeafId leaf = holds(graph_.leaf(slot), column, row) ? slot : finder_.leaf_at(column, row);
    if (graph_.is_local(leaf)) {
      placed_.push_back({graph_.local_index(leaf), t.nodes, nodes});
    } else {
      on_their_way_.add(graph_.rank_at(column, row), t);
    }
  }

  static bool holds(const Quadrant& leaf, std::int64_t column, std::int64_t row) {
    return leaf.x <= column && column < leaf.x + leaf.size() && leaf.y <= row && row < leaf.y + leaf.size();
  }

  /// The unit square with the centroid; the nodes are added up in the order of their coordinates, for the
  /// same sum on every rank.
  std::array<std::int64_t, 2> square_of(std::array<Point, 3> p) const {
    std::sort(p.begin(), p.end());
    return {lattice_.column_at((p[0].x + p[1].x + p[2].x) / 3),
            lattice_.row_at((p[0].y + p[1].y + p[2].y) / 3)};
  }

  const Lattice& lattice_;
  const LeafGraph& graph_;
  LeafFinder finder_;
  Mesh& mesh_;
  std::vector<PlacedTriangle> placed_;
  Outbox<FreeTriangle> on_their_way_;
};

}  // namespace

void make_delaunay(const Communicator& comm, const Lattice& lattice,
                   const std::function<TieRank(Point)>& rank_of, const LeafGraph& graph, const CutForest& cut,
                   Mesh& mesh, std::vector<LeafRecord>& leaves) {
  split_quads(mesh, leaves, [&](std::size_t leaf, const std::array<NodeId, 4>&) {
    return diagonal_of(graph.leaf(graph.from_local(static_cast<std::int32_t>(leaf))));
  });
  restore_delaunay_at(comm, mesh, nodes_of_cut_leaves(cut, mesh, leaves), rank_of);
  const std::vector<char> irregular = irregular_leaves(comm, graph, cut);
  LeafTriangles triangles(lattice, graph, mesh);
  triangles.share_out(comm, irregular, leaves);
  triangles.put_back(irregular, leaves);
}

}  // namespace quadloop
