// Meshes with layers, whole: valid, filling their outline, the same on any number of ranks.
#include "mesher/layers/add_layers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "mesher/base/error.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/geometry/outlines.hpp"
#include "tests/layers/walls.hpp"
#include "tests/mesh/same_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::ten_layers;
using test::world;

std::vector<Geometry> outlines() {
  return {test::floor_with_layers(ten_layers), test::step_with_layers(ten_layers),
          test::rhombus_with_layers(ten_layers, 0.25),
          test::outline_of({{{"floor", {{0, 0}}, ten_layers}, {"rest", {{8, 0}, {7, 2}, {-1, 2}}}}})};
}

double area_within(const Geometry& g) {
  double area = 0;
  for (std::int32_t loop = 0; loop < g.loop_count(); ++loop) area += test::loop_area(g, loop);
  return area;
}

TieRank by_place(Point p) { return tie_rank({0, 0}, p); }

/// The mesh outside, and what comes of it.
struct Layered {
  Layered(const Communicator& comm, const Geometry& g, bool divided) : front{layer_front(g)} {
    MeshOptions options;
    options.size.min = 0.05;
    options.size.max = 1;
    outside = build_mesh(comm, front.outer, options);
    mesh = outside.mesh;
    leaves = outside.tree.leaves;
    std::function<TieRank(Point)> divide;
    if (divided) divide = by_place;
    add_layers(comm, front, outside.edge_leaves, divide, mesh, leaves);
  }
  LayerFront front;
  MeshResult outside;
  Mesh mesh;
  std::vector<LeafRecord> leaves;
};

TEST(AddLayers, MeshesAreValidAndFillTheWholeOutline) {
  for (const Geometry& g : outlines()) {
    for (const bool divided : {false, true}) {
      const Layered made(world(), g, divided);
      const Mesh whole = gather_whole(world(), made.mesh);
      if (!world().is_root()) continue;
      EXPECT_TRUE(validate(whole).empty());
      EXPECT_NEAR(area_of(whole), area_within(g), 1e-6 * area_within(g)) << "chords cut bends";
    }
  }
}

TEST(AddLayers, MeshesAreTheSameOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  for (const Geometry& g : outlines()) {
    for (const bool divided : {false, true}) {
      const Layered made(world(), g, divided), alone(self, g, divided);
      const Mesh whole = gather_whole(world(), made.mesh), of_one = gather_whole(self, alone.mesh);
      if (world().is_root()) test::expect_same_meshes(whole, of_one);
    }
  }
}

TEST(AddLayers, EachFrontEdgeBecomesAColumnOfAsManyCells) {
  const Layered made(world(), test::floor_with_layers(ten_layers), false);
  const auto edges_of = [](const Mesh& mesh, std::size_t b) {
    return world().sum(std::ssize(mesh.boundaries[b].edges));
  };
  const std::int64_t columns = edges_of(made.outside.mesh, 0);
  EXPECT_EQ(world().sum(std::ssize(made.mesh.quads)),
            world().sum(std::ssize(made.outside.mesh.quads)) + 10 * columns);
  EXPECT_EQ(world().sum(made.mesh.owned_nodes),
            world().sum(made.outside.mesh.owned_nodes) + 10 * (columns + 1));
  EXPECT_EQ(edges_of(made.mesh, 0), columns);
  EXPECT_EQ(edges_of(made.mesh, 1), edges_of(made.outside.mesh, 1) + 20)
      << "the last columns lie on the sides";
  for (const auto& edge : made.mesh.boundaries[0].edges) {
    EXPECT_EQ(made.mesh.point(edge[0]).y, 0);
    EXPECT_EQ(made.mesh.point(edge[1]).y, 0);
  }
}

TEST(AddLayers, DividedOnesHaveTwoTrianglesForEachQuad) {
  for (const Geometry& g : outlines()) {
    const Layered whole(world(), g, false), divided(world(), g, true);
    const auto added = [](const Layered& made, auto kind) {
      return world().sum(std::ssize(made.mesh.*kind)) - world().sum(std::ssize(made.outside.mesh.*kind));
    };
    EXPECT_EQ(added(divided, &Mesh::quads), 0);
    EXPECT_EQ(added(divided, &Mesh::triangles),
              added(whole, &Mesh::triangles) + 2 * added(whole, &Mesh::quads));
  }
}

TEST(AddLayers, QuadsAreDividedByTheirShorterDiagonals) {
  int with_skew = 0;
  for (const Geometry& g : outlines()) {
    const Layered made(world(), g, false), divided(world(), g, true);
    const Mesh quads = gather_whole(world(), made.mesh), halves = gather_whole(world(), divided.mesh);
    std::set<std::pair<NodeId, NodeId>> edges;
    for (const auto& cell : halves.triangles) {
      for (std::size_t k = 0; k < 3; ++k) edges.emplace(cell[k], cell[(k + 1) % 3]);
    }
    const std::set<std::array<NodeId, 4>> kept(halves.quads.begin(), halves.quads.end());
    const auto diagonal = [&](const std::array<NodeId, 4>& quad, std::size_t k) {
      return length(quads.point(quad[k + 2]) - quads.point(quad[k]));
    };
    std::int32_t skew = 0;
    for (const auto& quad : quads.quads) {
      if (kept.contains(quad) || std::abs(diagonal(quad, 0) - diagonal(quad, 1)) < 1e-9) continue;
      const std::size_t k = diagonal(quad, 0) < diagonal(quad, 1) ? 0 : 1;
      EXPECT_TRUE(edges.contains({quad[k], quad[k + 2]}));
      ++skew;
    }
    with_skew += skew > 10 ? 1 : 0;
  }
  EXPECT_EQ(world().sum(with_skew), 3) << "outlines whose layers are not all rectangles";
}

TEST(AddLayers, LeavesCountTheCellsOverTheirEdgesAndTheseStandBehindTheirOwn) {
  const Layered made(world(), test::floor_with_layers(ten_layers), false);
  std::vector<std::int64_t> edges(made.leaves.size(), 0);
  for (const std::int32_t leaf : made.outside.edge_leaves[0]) ++edges[leaf];
  std::size_t quad = 0;
  for (std::size_t i = 0; i < made.leaves.size(); ++i) {
    const LeafRecord &before = made.outside.tree.leaves[i], &after = made.leaves[i];
    EXPECT_EQ(after.triangles, before.triangles);
    EXPECT_EQ(after.quads, before.quads + 10 * edges[i]);
    EXPECT_EQ(after.block, after.triangles + after.quads > 0 ? 1 : 0);
    for (std::int32_t k = 0; k < after.quads; ++k, ++quad) {
      double highest = 0;
      for (const NodeId node : made.mesh.quads[quad]) highest = std::max(highest, made.mesh.point(node).y);
      const bool in_layers = highest <= layers_thickness(ten_layers) * (1 + 1e-12);
      EXPECT_EQ(in_layers, k >= before.quads);
    }
  }
}

TEST(AddLayers, ACellThatIsNotPositiveIsRefusedOnAllRanks) {
  const Geometry geometry = test::floor_with_layers(ten_layers);
  const LayerFront front = layer_front(geometry);
  MeshOptions options;
  options.size.min = 0.05;
  options.size.max = 1;
  MeshResult outside = build_mesh(world(), front.outer, options);
  for (Point& p : outside.mesh.points) {
    if (p.y < 0.52 && std::abs(p.x - 4) < 1) p.y = -0.1;  // below the wall
  }
  const std::string message = test::refusal(
      [&] { add_layers(world(), front, outside.edge_leaves, {}, outside.mesh, outside.tree.leaves); });
  EXPECT_NE(message.find("a cell of the layers would be inverted; use a smaller spacing"), std::string::npos);
}

}  // namespace
}  // namespace quadloop
