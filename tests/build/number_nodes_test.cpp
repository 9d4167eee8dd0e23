// Nodes are numbered along the curve, alike on any number of ranks, and lie where leaves have them.
#include "mesher/build/number_nodes.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "mesher/base/ids.hpp"
#include "mesher/build/sized_domain.hpp"
#include "mesher/forest/refine_forest.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

Geometry square(double edge) {
  return {{{"frame", edge, 30, "none"}},
          {{0, 0}, {edge, 0}, {edge, edge}, {0, edge}},
          {0, 4},
          std::vector<BoundaryId>(4, BoundaryId{0})};
}

/// A disc of void in a square, which asks for leaves finer than those of the frame.
Geometry square_with_disc() {
  std::vector<Point> points{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  std::vector<BoundaryId> boundary(4, BoundaryId{0});
  for (int i = 0; i < 48; ++i) {
    const double angle = -2 * std::numbers::pi * i / 48;
    points.push_back({1.75 + 0.6 * std::cos(angle), 2.3 + 0.6 * std::sin(angle)});
    boundary.push_back(BoundaryId{1});
  }
  return {{{"frame", 1, 30, "none"}, {"disc", 0.125, 30, "wall"}}, points, {0, 4, 52}, boundary};
}

SizeOptions sizes_from(double min, double max) {
  SizeOptions options;
  options.min = min;
  options.max = max;
  return options;
}

/// A forest cut and numbered, with what was found of its nodes.
struct Numbered {
  Numbered(const Geometry& given, const SizeOptions& options)
      : geometry{given},
        demanded{test::world(), {}},
        domain{geometry, options, demanded},
        graph{refine_forest(test::world(), domain.sizes)},
        cut{cut_forest(test::world(), graph, domain.sizes, domain.outline, domain.inside, 0.4)},
        numbers{test::world(), domain.grid, graph, cut} {}

  Mesh mesh() {
    Mesh mesh;
    std::move(numbers).fill(mesh);
    return mesh;
  }

  Geometry geometry;
  DemandedSplits demanded;
  SizedDomain domain;
  LeafGraph graph;
  CutForest cut;
  NodeNumbering numbers;
};

struct Node {
  std::int64_t number;
  Point position;
  friend auto operator<=>(const Node&, const Node&) = default;
};

/// All nodes of all ranks by their global numbers; what is held twice is there once.
std::vector<Node> all_nodes(const Mesh& mesh) {
  std::vector<Node> own;
  for (std::int32_t n = 0; n < size32(mesh.points); ++n) {
    const std::int64_t number =
        n < mesh.owned_nodes ? mesh.first_node + n : mesh.ghosts[n - mesh.owned_nodes].value();
    own.push_back({number, mesh.points[n]});
  }
  std::vector<Node> all = test::world().all_gather_values(std::span<const Node>(own));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

TEST(NodeNumbering, NodesBelongToTheFirstLeafAlongTheCurve) {
  Numbered numbered(square(2), sizes_from(1, 1));
  const std::vector<Point> along_curve{{0, 0}, {1, 0}, {0, 1}, {1, 1},  // the lower left leaf has four
                                       {2, 0}, {2, 1}, {0, 2}, {1, 2}, {2, 2}};
  const std::vector<Node> nodes = all_nodes(numbered.mesh());
  ASSERT_EQ(nodes.size(), along_curve.size());
  for (std::size_t n = 0; n < nodes.size(); ++n)
    EXPECT_EQ(nodes[n], (Node{static_cast<std::int64_t>(n), along_curve[n]}));
}

TEST(NodeNumbering, NumbersAndPositionsGoTogether) {
  Numbered numbered(square_with_disc(), sizes_from(0.125, 1));
  const std::vector<Node> nodes = all_nodes(numbered.mesh());
  std::map<Point, std::int64_t> number_at;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    EXPECT_EQ(nodes[n].number, static_cast<std::int64_t>(n)) << "none is left out, none twice";
    EXPECT_TRUE(number_at.emplace(nodes[n].position, nodes[n].number).second) << "two nodes at one position";
  }
  EXPECT_GT(nodes.size(), 100U);
}

TEST(NodeNumbering, LeavesHaveTheirNodesAtTheirCornersAndMiddles) {
  Numbered numbered(square_with_disc(), sizes_from(0.125, 1));
  const LeafGraph& graph = numbered.graph;
  std::map<GridPoint, Point> moved;
  for (const CutForest::Moved& m : numbered.cut.moved) moved[m.corner] = m.position;
  EXPECT_GT(moved.size(), 0U);
  struct Expected {
    NodeId node;
    Point position;
  };
  std::vector<Expected> expected;
  std::int64_t hanging = 0;
  for (const LeafId leaf : graph.local()) {
    if (numbered.cut.states[graph.local_index(leaf)] != CutForest::State::inside) continue;
    const Quadrant& q = graph.leaf(leaf);
    const NodeNumbering::SiteNodes nodes = numbered.numbers.of_leaf(leaf);
    for (const Site site : grid_sites) {
      EXPECT_EQ(nodes[index_of(site)].valid(), is_corner(site) || graph.has_hanging(leaf, side_of(site)));
      if (!nodes[index_of(site)].valid()) continue;
      hanging += is_middle(site) ? 1 : 0;
      const auto at = moved.find(q.at(site));
      expected.push_back(
          {nodes[index_of(site)], at != moved.end() ? at->second : numbered.domain.grid.corner(q.at(site))});
    }
  }
  EXPECT_GT(test::world().sum(hanging), 0);
  const Mesh mesh = numbered.mesh();
  for (const Expected& e : expected) EXPECT_EQ(mesh.points[e.node.value()], e.position);
}

TEST(NodeNumbering, CellsOfCutLeavesHaveTheirNodesWhereTheyWereCut) {
  Numbered numbered(square_with_disc(), sizes_from(0.125, 1));
  const LeafGraph& graph = numbered.graph;
  std::vector<std::pair<NodeId, Point>> expected;
  for (const LeafId leaf : graph.local()) {
    const std::int32_t e = numbered.cut.entry_of[graph.local_index(leaf)];
    if (e < 0) continue;
    const CutForest::Entry& entry = numbered.cut.entries[e];
    for (const auto& t :
         CutForest::part(numbered.cut.triangles, entry.begin.triangles, entry.end.triangles)) {
      for (const std::int32_t n : t) {
        const std::int32_t node = entry.begin.nodes + n;
        expected.emplace_back(numbered.numbers.of_cut(leaf, node), numbered.cut.nodes[node].position);
      }
    }
  }
  EXPECT_GT(test::world().sum(std::ssize(expected)), 0);
  const Mesh mesh = numbered.mesh();
  for (const auto& [node, position] : expected) EXPECT_EQ(mesh.points[node.value()], position);
}

}  // namespace
}  // namespace quadloop
