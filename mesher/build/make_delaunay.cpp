#include "mesher/build/make_delaunay.hpp"

#include <algorithm>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/delaunay/flipper.hpp"
#include "mesher/delaunay/restore/restore_delaunay.hpp"
#include "mesher/forest/leaf_exchange.hpp"
#include "mesher/mesh/node_table.hpp"

namespace quadloop {

namespace {

/// A local leaf that is cut or has a snapped corner, or that touches such a leaf.
struct IrregularLeaf {
  std::int32_t index = 0;     ///< local index
  std::int32_t triangle = 0;  ///< its first triangle, before any triangle moves to another leaf
  std::int32_t count = 0;     ///< number of its triangles
  bool cut = false;           ///< cut, or with a snapped corner

  std::int32_t end() const { return triangle + count; }
};

/// Flags the irregular leaves of the graph. *Collective.*
std::vector<char> flag_irregular(const LeafGraph& graph, const std::vector<char>& is_cut) {
  std::vector<char> irregular = is_cut;
  LeafFinder finder(graph);
  for (const LeafId leaf : graph.all()) {
    if (is_cut[leaf.value()] == 0) continue;
    for_touching_leaves(finder, leaf, [&](LeafId other) { irregular[other.value()] = 1; });
  }
  return irregular;
}

/// Returns the irregular leaves in ascending order. *Collective.*
std::vector<IrregularLeaf> irregular_leaves(const Communicator& comm, const LeafGraph& graph,
                                            const CutForest& cut, const std::vector<LeafRecord>& leaves) {
  std::vector<char> is_cut(graph.size(), 0);
  for (std::int32_t i = 0; i < std::ssize(cut.entry_of); ++i) {
    is_cut[graph.from_local(i).value()] = cut.entry_of[i] >= 0 ? 1 : 0;
  }
  LeafExchange(comm, graph).update(is_cut);
  const std::vector<char> is_irregular = flag_irregular(graph, is_cut);
  std::vector<IrregularLeaf> irregular;
  std::int32_t triangle = 0;
  for (std::int32_t i = 0; i < std::ssize(leaves); ++i) {
    if (is_irregular[graph.from_local(i).value()] != 0)
      irregular.push_back({i, triangle, leaves[i].triangles, cut.entry_of[i] >= 0});
    triangle += leaves[i].triangles;
  }
  return irregular;
}

std::size_t count_triangles(const std::vector<IrregularLeaf>& irregular, bool cut) {
  std::size_t count = 0;
  for (const IrregularLeaf& leaf : irregular) count += leaf.cut == cut ? leaf.count : 0;
  return count;
}

/// This rank's edges of inner lines, as Flipper::keep() takes them. An edge of another rank is the side of a
/// leaf of that rank, so that only one of its triangles is here.
std::vector<Flipper::Ends> edges_of_lines(const Mesh& mesh) {
  std::vector<Flipper::Ends> edges;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    if (!boundary.inner_line) continue;
    for (const auto& [from, to] : boundary.edges)
      edges.push_back({std::min(from, to).value(), std::max(from, to).value()});
  }
  std::ranges::sort(edges);
  return edges;
}

/// Flips the edges between this rank's triangles in irregular leaves until they are Delaunay. Edges of uncut
/// leaves are already Delaunay, except for those to cut leaves. Returns the nodes at edges to other ranks'
/// triangles; each is a ghost on one of the two ranks.
std::vector<GlobalNodeId> flip_own_triangles(const std::function<TieRank(Point)>& rank_of,
                                             const std::vector<IrregularLeaf>& irregular, Mesh& mesh) {
  const std::size_t of_cut = count_triangles(irregular, true);
  std::vector<Flipper::Triangle> triangles(of_cut + count_triangles(irregular, false));
  const std::vector<std::int32_t>& block_of = mesh.blocks.of_triangles;
  std::vector<std::int32_t> blocks(block_of.empty() ? 0 : triangles.size());
  const auto for_each_triangle = [&](const auto& visit) {
    std::array<std::size_t, 2> next{of_cut, 0};  // of uncut leaves, and of cut ones
    for (const IrregularLeaf& leaf : irregular) {
      for (std::int32_t t = leaf.triangle; t < leaf.end(); ++t) {
        const std::size_t listed = next[leaf.cut ? 1 : 0]++;
        if (!blocks.empty()) blocks[listed] = block_of[t];
        visit(mesh.triangles[t], triangles[listed]);
      }
    }
  };
  std::vector<GlobalNodeId> shared;
  for_each_triangle([&](const std::array<NodeId, 3>& nodes, Flipper::Triangle& listed) {
    listed = {nodes[0].value(), nodes[1].value(), nodes[2].value()};
    for (const NodeId node : nodes) {
      if (!mesh.owns(node)) shared.push_back(mesh.global(node));
    }
  });
  Flipper flipper;
  flipper.keep(edges_of_lines(mesh));
  flipper.flip_first(
      mesh.points, [&](std::int32_t node) { return rank_of(mesh.points[node]); }, triangles, of_cut, blocks);
  for_each_triangle([](std::array<NodeId, 3>& nodes, const Flipper::Triangle& flipped) {
    const auto& [a, b, c] = flipped;
    nodes = {NodeId{a}, NodeId{b}, NodeId{c}};
  });
  return shared;
}

using GlobalNodes = std::array<GlobalNodeId, 3>;

/// A triangle sent to the rank of its leaf.
struct FreeTriangle {
  std::int32_t block;
  GlobalNodes nodes;
  std::array<Point, 3> points;
};

/// A triangle with its leaf.
struct PlacedTriangle {
  std::int32_t leaf = 0;     ///< local index
  GlobalNodes global_nodes;  ///< starting from the smallest
  std::array<NodeId, 3> nodes;
  std::int32_t block = 0;
  friend auto operator<=>(const PlacedTriangle&, const PlacedTriangle&) = default;
};

/// The blocks of the triangles, if there are several, after those of irregular leaves have been replaced.
class NewBlocks {
 public:
  explicit NewBlocks(std::vector<std::int32_t>& blocks) : old_{blocks} { made_.reserve(blocks.size()); }

  void replace(const IrregularLeaf& leaf, const std::vector<PlacedTriangle>& by) {
    if (old_.empty()) return;
    made_.insert(made_.end(), old_.begin() + taken_, old_.begin() + leaf.triangle);
    for (const PlacedTriangle& t : by) made_.push_back(t.block);
    taken_ = leaf.end();
  }
  void finish() {
    made_.insert(made_.end(), old_.begin() + taken_, old_.end());
    old_ = std::move(made_);
  }

 private:
  std::vector<std::int32_t>& old_;
  std::vector<std::int32_t> made_;
  std::int32_t taken_ = 0;
};

/// Moves the triangles of irregular leaves to the leaves that contain their centroids; most are already
/// there.
class LeafTriangles {
 public:
  LeafTriangles(const TreeGrid& grid, const LeafGraph& graph, Mesh& mesh)
      : grid_{grid}, graph_{graph}, finder_{graph}, mesh_{mesh} {}

  /// *Collective.*
  void share_out(const Communicator& comm, const std::vector<IrregularLeaf>& irregular) {
    for (const IrregularLeaf& leaf : irregular) send_strangers(leaf);
    NodeTable table(mesh_);
    for (const FreeTriangle& t : on_their_way_.deliver(comm)) {
      const Point p = centroid(t.points);
      const LeafId leaf = finder_.leaf_at(grid_.column_at(p.x), grid_.row_at(p.y));
      PlacedTriangle placed{graph_.local_index(leaf), t.nodes, {}, t.block};
      for (std::size_t k = 0; k < 3; ++k) placed.nodes[k] = table.local(t.nodes[k], t.points[k]);
      arrived_.push_back(placed);
    }
    std::sort(arrived_.begin(), arrived_.end());
  }

  /// Stores the triangles. In irregular leaves all are sorted by their node numbers.
  void put_back(const std::vector<IrregularLeaf>& irregular, std::vector<LeafRecord>& leaves) const {
    auto& all = mesh_.triangles;
    const auto room = std::ssize(arrived_) + 1;  // at the front: nothing is overwritten before it is read
    all.reserve(all.size() + room);
    all.insert(all.begin(), room, {});
    auto written = all.begin();
    auto next = all.begin() + room;  // the next triangle that has not been moved
    auto arrival = arrived_.cbegin();
    auto stranger = strangers_.cbegin();
    std::vector<PlacedTriangle> here;
    NewBlocks blocks(mesh_.blocks.of_triangles);
    for (const IrregularLeaf& leaf : irregular) {
      const auto begin = all.begin() + room + leaf.triangle;
      written = std::copy(next, begin, written);
      next = begin + leaf.count;
      here.clear();
      for (std::int32_t t = leaf.triangle; t < leaf.end(); ++t) {
        if (stranger != strangers_.end() && *stranger == t) {
          ++stranger;
        } else {
          here.push_back(placed(leaf.index, begin[t - leaf.triangle], block_of(t)));
        }
      }
      for (; arrival != arrived_.end() && arrival->leaf == leaf.index; ++arrival) here.push_back(*arrival);
      std::sort(here.begin(), here.end());
      written =
          std::transform(here.begin(), here.end(), written, [](const PlacedTriangle& t) { return t.nodes; });
      leaves[leaf.index].triangles = size32(here);
      leaves[leaf.index].block = here.empty() ? 0 : static_cast<std::int16_t>(here.front().block + 1);
      blocks.replace(leaf, here);
    }
    blocks.finish();
    all.erase(std::copy(next, all.end(), written), all.end());
    QUADLOOP_REQUIRE(arrival == arrived_.end(), "the centroid of each triangle lies in an irregular leaf");
  }

 private:
  /// Sends a leaf's triangles, one range of the mesh, whose centroids lie in other leaves.
  void send_strangers(const IrregularLeaf& from) {
    const LeafId leaf = graph_.from_local(from.index);
    const Box box = grid_.box_of(graph_.leaf(leaf));
    for (std::int32_t t = from.triangle; t < from.end(); ++t) {
      const std::array<NodeId, 3>& nodes = mesh_.triangles[t];
      const std::array<Point, 3> points{mesh_.point(nodes[0]), mesh_.point(nodes[1]), mesh_.point(nodes[2])};
      if (is_surely_in(box, points)) continue;
      const Point p = centroid(points);
      if (box.low.x <= p.x && p.x < box.high.x && box.low.y <= p.y && p.y < box.high.y) continue;
      const std::int64_t column = grid_.column_at(p.x), row = grid_.row_at(p.y);
      const LeafId home = finder_.leaf_at(column, row);
      if (home == leaf) continue;
      strangers_.push_back(t);
      const PlacedTriangle stranger = placed(graph_.local_index(home), nodes, block_of(t));
      if (graph_.is_local(home)) {
        arrived_.push_back(stranger);
      } else {
        FreeTriangle free{stranger.block, stranger.global_nodes, {}};
        for (std::size_t k = 0; k < 3; ++k) free.points[k] = mesh_.point(stranger.nodes[k]);
        on_their_way_.add(graph_.rank_at(column, row), free);
      }
    }
  }

  std::int32_t block_of(std::int32_t triangle) const {
    return mesh_.blocks.of_triangles.empty() ? 0 : mesh_.blocks.of_triangles[triangle];
  }

  PlacedTriangle placed(std::int32_t leaf, std::array<NodeId, 3> nodes, std::int32_t block) const {
    const auto before = [&](NodeId a, NodeId b) { return mesh_.global(a) < mesh_.global(b); };
    std::rotate(nodes.begin(), std::min_element(nodes.begin(), nodes.end(), before), nodes.end());
    return {leaf, {mesh_.global(nodes[0]), mesh_.global(nodes[1]), mesh_.global(nodes[2])}, nodes, block};
  }

  /// Whether the centroid is inside a leaf with a margin larger than any rounding error.
  static bool is_surely_in(const Box& leaf, const std::array<Point, 3>& p) {
    // Relative to the leaf's edge: ten times the rounding error of the sum (TreeGrid::finest_level).
    constexpr double rim = 0.125;
    const double margin = rim * leaf.width(), x = (p[0].x + p[1].x + p[2].x) / 3,
                 y = (p[0].y + p[1].y + p[2].y) / 3;
    return leaf.low.x + margin < x && x < leaf.high.x - margin && leaf.low.y + margin < y &&
           y < leaf.high.y - margin;
  }

  /// Sums the nodes in the order of their coordinates, so that all ranks get the same result.
  static Point centroid(std::array<Point, 3> p) {
    std::sort(p.begin(), p.end());
    return {(p[0].x + p[1].x + p[2].x) / 3, (p[0].y + p[1].y + p[2].y) / 3};
  }

  const TreeGrid& grid_;
  const LeafGraph& graph_;
  LeafFinder finder_;
  Mesh& mesh_;
  std::vector<std::int32_t> strangers_;  ///< triangles of the mesh that leave their leaves, ascending
  std::vector<PlacedTriangle> arrived_;
  Outbox<FreeTriangle> on_their_way_;
};

}  // namespace

void make_delaunay(const Communicator& comm, const TreeGrid& grid,
                   const std::function<TieRank(Point)>& rank_of, const LeafGraph& graph, const CutForest& cut,
                   Mesh& mesh, std::vector<LeafRecord>& leaves) {
  const std::vector<IrregularLeaf> irregular = irregular_leaves(comm, graph, cut, leaves);
  restore_delaunay_at(comm, mesh, flip_own_triangles(rank_of, irregular, mesh), rank_of,
                      mesh.blocks.of_triangles);
  LeafTriangles triangles(grid, graph, mesh);
  triangles.share_out(comm, irregular);
  triangles.put_back(irregular, leaves);
}

}  // namespace quadloop
