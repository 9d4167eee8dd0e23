#include "mesher/build/make_delaunay.hpp"

#include <algorithm>
#include <optional>

#include "mesher/base/error.hpp"
#include "mesher/build/cell_halo.hpp"
#include "mesher/cut/lattice_rank.hpp"
#include "mesher/delaunay/delaunay_patch.hpp"
#include "mesher/forest/ghost_exchange.hpp"
#include "mesher/mesh/node_table.hpp"

namespace quadloop {

namespace {

constexpr int first_rings = 2;  ///< fetched at once; more where circumcircles reach farther

using GlobalTriangle = std::array<std::int64_t, 3>;

/// A triangle of the result and the local leaf that it belongs to.
struct Placed {
  std::int32_t leaf = 0;
  GlobalTriangle nodes{};
  friend auto operator<=>(const Placed&, const Placed&) = default;
};

/// Flags, for local leaves and ghosts, the leaves whose cells may not be Delaunay: the cut ones, those with a
/// snapped corner, and all around them.
std::vector<char> irregular_leaves(const GhostExchange& exchange, const LeafGraph& graph,
                                   const CutForest& cut) {
  std::vector<char> cut_flags(static_cast<std::size_t>(graph.size()), 0), irregular;
  for (std::size_t i = 0; i < cut.entry_of.size(); ++i) {
    cut_flags[static_cast<std::size_t>(graph.from_local(static_cast<std::int32_t>(i)))] =
        cut.entry_of[i] >= 0 ? 1 : 0;
  }
  exchange.update(cut_flags);
  irregular = cut_flags;
  for (std::int32_t leaf = 0; leaf < graph.size(); ++leaf) {
    if (cut_flags[static_cast<std::size_t>(leaf)] == 0) continue;
    for_touching_leaves(graph, leaf,
                        [&](std::int32_t other) { irregular[static_cast<std::size_t>(other)] = 1; });
  }
  exchange.update(irregular);
  return irregular;
}

/// The hybrid mesh's cells leaf by leaf.
class CellsOfLeaves {
 public:
  CellsOfLeaves(const Communicator& comm, const LeafGraph& graph, const Mesh& mesh,
                const std::vector<LeafRecord>& leaves)
      : rank_{comm.rank()}, graph_{graph}, mesh_{mesh} {
    for (const LeafRecord& leaf : leaves) {
      first_triangle_.push_back(first_triangle_.back() + static_cast<std::size_t>(leaf.triangles));
      first_quad_.push_back(first_quad_.back() + static_cast<std::size_t>(leaf.quads));
    }
  }

  std::span<const std::array<NodeId, 3>> triangles(std::size_t index) const {
    return std::span(mesh_.triangles)
        .subspan(first_triangle_[index], first_triangle_[index + 1] - first_triangle_[index]);
  }
  std::span<const std::array<NodeId, 4>> quads(std::size_t index) const {
    return std::span(mesh_.quads).subspan(first_quad_[index], first_quad_[index + 1] - first_quad_[index]);
  }

  /// Any triangles that cover the cells of a local leaf.
  void append_free(std::int32_t leaf, std::vector<FreeTriangle>& out) const {
    const std::int32_t index = leaf - graph_.local_begin();
    const auto add = [&](NodeId a, NodeId b, NodeId c) {
      FreeTriangle t{{rank_, index}, {}, {mesh_.point(a), mesh_.point(b), mesh_.point(c)}};
      t.nodes = {mesh_.global(a).value(), mesh_.global(b).value(), mesh_.global(c).value()};
      out.push_back(t);
    };
    for (const auto& t : triangles(static_cast<std::size_t>(index))) add(t[0], t[1], t[2]);
    for (const auto& q : quads(static_cast<std::size_t>(index))) {
      add(q[0], q[1], q[2]);
      add(q[0], q[2], q[3]);
    }
  }

 private:
  std::int32_t rank_;
  const LeafGraph& graph_;
  const Mesh& mesh_;
  std::vector<std::size_t> first_triangle_{0}, first_quad_{0};
};

/// The constrained Delaunay triangulation of this rank's irregular leaves and of the halo around them.
class LocalTriangulation {
 public:
  LocalTriangulation(const Lattice& lattice, int finest_level, const LeafGraph& graph,
                     std::span<const FreeTriangle> own, const CellHalo& halo)
      : lattice_{lattice}, graph_{graph} {
    gather_nodes(own, halo.triangles());
    std::vector<TieRank> ranks;
    for (const Point& p : points_) ranks.push_back(tie_rank(lattice, finest_level, p));
    std::vector<DelaunayPatch::Triangle> triangles;
    std::vector<char> open;
    for (const auto& part : {own, halo.triangles()}) {
      for (const FreeTriangle& t : part) {
        triangles.push_back({node_of(t.nodes[0]), node_of(t.nodes[1]), node_of(t.nodes[2])});
        open.push_back(halo.at_rim(t.leaf) ? 1 : 0);
      }
    }
    patch_.emplace(std::move(points_), ranks, std::move(triangles), open);
    place();
  }

  /// The triangles of local leaves, sorted.
  const std::vector<Placed>& placed() const { return placed_; }
  /// Whether nodes out of sight might change some of them.
  bool uncertain() const { return uncertain_; }
  Point point(std::int64_t node) const { return patch_->point(node_of(node)); }

 private:
  void gather_nodes(std::span<const FreeTriangle> own, std::span<const FreeTriangle> others) {
    std::vector<std::pair<std::int64_t, Point>> nodes;
    for (const auto& part : {own, others}) {
      for (const FreeTriangle& t : part) {
        for (std::size_t k = 0; k < 3; ++k) nodes.emplace_back(t.nodes[k], t.points[k]);
      }
    }
    std::sort(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [number, point] : nodes) {
      if (!numbers_.empty() && numbers_.back() == number) continue;
      numbers_.push_back(number);
      points_.push_back(point);
    }
  }

  std::int32_t node_of(std::int64_t number) const {
    return static_cast<std::int32_t>(std::lower_bound(numbers_.begin(), numbers_.end(), number) -
                                     numbers_.begin());
  }

  void place() {
    const std::vector<char> doubts = patch_->doubtful();
    const auto& triangles = patch_->triangles();
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const std::int32_t leaf = leaf_of(triangles[t]);
      if (leaf == LeafGraph::none || !graph_.is_local(leaf)) continue;
      uncertain_ = uncertain_ || doubts[t] != 0;
      Placed placed{leaf, {}};
      for (std::size_t k = 0; k < 3; ++k)
        placed.nodes[k] = numbers_[static_cast<std::size_t>(triangles[t][k])];
      std::rotate(placed.nodes.begin(), std::min_element(placed.nodes.begin(), placed.nodes.end()),
                  placed.nodes.end());
      placed_.push_back(placed);
    }
    std::sort(placed_.begin(), placed_.end());
  }

  /// The leaf with the centroid; the nodes are added up in the order of their coordinates, for the same sum
  /// on every rank.
  std::int32_t leaf_of(const DelaunayPatch::Triangle& t) const {
    std::array<Point, 3> p{patch_->point(t[0]), patch_->point(t[1]), patch_->point(t[2])};
    std::sort(p.begin(), p.end());
    const Point centroid{(p[0].x + p[1].x + p[2].x) / 3, (p[0].y + p[1].y + p[2].y) / 3};
    return graph_.leaf_at(lattice_.column_at(centroid.x), lattice_.row_at(centroid.y));
  }

  const Lattice& lattice_;
  const LeafGraph& graph_;
  std::vector<std::int64_t> numbers_;  ///< over all ranks, ascending
  std::vector<Point> points_;
  std::optional<DelaunayPatch> patch_;
  std::vector<Placed> placed_;
  bool uncertain_ = false;
};

/// The two triangles of a leaf's square: of its diagonals the one through the corner that it shares with its
/// parent, whose coordinates have the most trailing zeros.
std::array<std::array<std::size_t, 3>, 2> halves_of(const Quadrant& q) {
  const bool rising = ((q.x & q.size()) != 0) == ((q.y & q.size()) != 0);
  if (rising) return {{{0, 1, 2}, {0, 2, 3}}};
  return {{{0, 1, 3}, {1, 2, 3}}};
}

/// Makes the mesh anew from the cells of regular leaves and the triangles of the others.
class Rebuilder {
 public:
  Rebuilder(const Mesh& hybrid, const LeafGraph& graph, const CellsOfLeaves& cells,
            const LocalTriangulation& triangulation)
      : hybrid_{hybrid}, graph_{graph}, cells_{cells}, triangulation_{triangulation}, table_{result_} {
    result_.first_node = hybrid.first_node;
    result_.owned_nodes = hybrid.owned_nodes;
    result_.points.assign(hybrid.points.begin(), hybrid.points.begin() + hybrid.owned_nodes);
    result_.triangles.reserve(hybrid.triangles.size() + 2 * hybrid.quads.size());
    for (const BoundaryEdges& b : hybrid.boundaries) {
      result_.boundaries.push_back({b.name, b.condition, {}});
      for (const auto& [from, to] : b.edges)
        result_.boundaries.back().edges.push_back({local(from), local(to)});
    }
  }

  void add_leaf(std::int32_t leaf, bool irregular) {
    if (!irregular) add_regular(leaf);
    const auto& placed = triangulation_.placed();
    for (; next_ < placed.size() && placed[next_].leaf == leaf; ++next_) {
      std::array<NodeId, 3> nodes;
      for (std::size_t k = 0; k < 3; ++k)
        nodes[k] = table_.local(placed[next_].nodes[k], triangulation_.point(placed[next_].nodes[k]));
      result_.triangles.push_back(nodes);
    }
  }

  Mesh take() { return std::move(result_); }
  std::size_t triangles() const { return result_.triangles.size(); }

 private:
  NodeId local(NodeId node) { return table_.local(hybrid_.global(node).value(), hybrid_.point(node)); }

  void add_regular(std::int32_t leaf) {
    const auto index = static_cast<std::size_t>(leaf - graph_.local_begin());
    for (const auto& t : cells_.triangles(index))
      result_.triangles.push_back({local(t[0]), local(t[1]), local(t[2])});
    for (const auto& q : cells_.quads(index)) {
      for (const auto& [a, b, c] : halves_of(graph_.leaf(leaf)))
        result_.triangles.push_back({local(q[a]), local(q[b]), local(q[c])});
    }
  }

  const Mesh& hybrid_;
  const LeafGraph& graph_;
  const CellsOfLeaves& cells_;
  const LocalTriangulation& triangulation_;
  Mesh result_;
  NodeTable table_;
  std::size_t next_ = 0;
};

std::vector<FreeTriangle> own_triangles(const LeafGraph& graph, const CellsOfLeaves& cells,
                                        const std::vector<char>& irregular) {
  std::vector<FreeTriangle> own;
  for (std::int32_t leaf = graph.local_begin(); leaf < graph.local_end(); ++leaf) {
    if (irregular[static_cast<std::size_t>(leaf)] != 0) cells.append_free(leaf, own);
  }
  return own;
}

}  // namespace

void make_delaunay(const Communicator& comm, const Lattice& lattice, int finest_level, const LeafGraph& graph,
                   const CutForest& cut, Mesh& mesh, std::vector<LeafRecord>& leaves) {
  const std::int64_t expected =
      comm.sum(static_cast<std::int64_t>(mesh.triangles.size() + 2 * mesh.quads.size()));
  const GhostExchange exchange(comm, graph);
  const std::vector<char> irregular = irregular_leaves(exchange, graph, cut);
  const CellsOfLeaves cells(comm, graph, mesh, leaves);
  const std::vector<FreeTriangle> own = own_triangles(graph, cells, irregular);
  CellHalo halo(comm, graph, irregular,
                [&](std::int32_t leaf, std::vector<FreeTriangle>& out) { cells.append_free(leaf, out); });
  for (int ring = 0; ring < first_rings; ++ring) halo.grow();
  std::optional<LocalTriangulation> triangulation;
  while (true) {
    triangulation.emplace(lattice, finest_level, graph, own, halo);
    if (!comm.any(triangulation->uncertain() && !halo.complete())) break;
    halo.grow();
  }
  Rebuilder rebuilder(mesh, graph, cells, *triangulation);
  for (std::int32_t leaf = graph.local_begin(); leaf < graph.local_end(); ++leaf) {
    const std::size_t before = rebuilder.triangles();
    rebuilder.add_leaf(leaf, irregular[static_cast<std::size_t>(leaf)] != 0);
    LeafRecord& record = leaves[static_cast<std::size_t>(leaf - graph.local_begin())];
    record.triangles = static_cast<std::int32_t>(rebuilder.triangles() - before);
    record.quads = 0;
    record.mark = record.triangles > 0 ? 1 : 0;
  }
  Mesh delaunay = rebuilder.take();
  const std::int64_t made = comm.sum(static_cast<std::int64_t>(delaunay.triangles.size()));
  QUADLOOP_REQUIRE(made == expected,
                   "the Delaunay triangulation has as many triangles as any other of its nodes");
  mesh = std::move(delaunay);
}

}  // namespace quadloop
