// Whole meshes whose figures are known; what is refused before the work begins.
#include "mesher/build/build_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "mesher/build/mesh_estimate.hpp"
#include "mesher/mesh/check/delaunay_check.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

Geometry unit_square() {
  return {{{"side", 0, 30, "wall"}},
          {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
          {0, 4},
          std::vector<BoundaryId>(4, BoundaryId{0})};
}

MeshOptions sized(double min, double max) {
  MeshOptions options;
  options.size.min = min;
  options.size.max = max;
  return options;
}

/// Five points, all of them kept, so that the mesh has the polygon's own area.
Geometry pentagon() {
  std::vector<Point> points;
  for (int i = 0; i < 5; ++i) {
    const double angle = 2 * std::numbers::pi * (i / 5.0 + 0.017);
    points.push_back({std::cos(angle), std::sin(angle)});
  }
  return {{{"wall", 0.05, 30, "wall"}}, points, {0, 5}, std::vector<BoundaryId>(5, BoundaryId{0})};
}

const double pentagon_area = 2.5 * std::sin(2 * std::numbers::pi / 5);

TEST(BuildMesh, ASquareIsSquares) {
  const MeshResult made = build_mesh(world(), unit_square(), sized(0.125, 0.125));
  EXPECT_EQ(made.tree.attributes.nodes, 81);
  EXPECT_EQ(made.tree.attributes.quads, 64);
  EXPECT_EQ(made.tree.attributes.triangles, 0);
  EXPECT_EQ(made.report.leaves, 64);
  EXPECT_EQ(made.report.finest_level, 3);
  EXPECT_EQ(summarise_quality(world(), made.mesh).worst, 1);
  EXPECT_TRUE(made.report.warnings.empty());
  std::int64_t edges = 0;
  for (const BoundaryEdges& boundary : made.mesh.boundaries) edges += std::ssize(boundary.edges);
  EXPECT_EQ(world().sum(edges), 32);
}

TEST(BuildMesh, AGridVertexOnASlantedSideUpToRoundingIsOneNode) {
  // Each slanted side passes a grid vertex at a distance of 1e-16, in a leaf beside which a wall lies on a
  // grid line.
  const Geometry slanted{{{"wall", 0, 30, "wall"}},
                         {{1.25, 0.25}, {1.5, 0.3}, {1.5, 1.3}, {1.25, 1.25}},
                         {0, 4},
                         std::vector<BoundaryId>(4, BoundaryId{0})};
  MeshOptions options = sized(0.125, 0.125);
  options.size.root = RootOptions{{-0.25, -0.35}, 2, 1, 1};
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    options.type = type;
    EXPECT_GT(summarise_quality(world(), build_mesh(world(), slanted, options).mesh).smallest_degrees, 30);
  }
}

TEST(BuildMesh, MeshesAreValidFillTheOutlineAndAreTheSameOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  for (const auto& [type, quads] : {std::pair{MeshType::hybrid, QuadChoice::all},
                                    {MeshType::hybrid, QuadChoice::parallel},
                                    {MeshType::delaunay, QuadChoice::all}}) {
    MeshOptions options = sized(0.02, 0.2);
    options.type = type;
    options.quads = quads;
    const MeshResult made = build_mesh(world(), pentagon(), options),
                     alone = build_mesh(self, pentagon(), options);
    const Mesh whole = gather_whole(world(), made.mesh), of_one = gather_whole(self, alone.mesh);
    if (!world().is_root()) continue;
    EXPECT_TRUE(validate(whole).empty());
    EXPECT_NEAR(area_of(whole), pentagon_area, 1e-12);
    EXPECT_EQ(whole.points, of_one.points);
    EXPECT_EQ(whole.triangles, of_one.triangles);
    EXPECT_EQ(whole.quads, of_one.quads);
    EXPECT_EQ(is_delaunay(whole), type == MeshType::delaunay);
  }
}

TEST(BuildMesh, TheTreeCountsEachLeafsCells) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshOptions options = sized(0.02, 0.2);
    options.type = type;
    const MeshResult made = build_mesh(world(), pentagon(), options);
    std::int64_t triangles = 0, quads = 0;
    for (const LeafRecord& leaf : made.tree.leaves) {
      triangles += leaf.triangles;
      quads += leaf.quads;
      EXPECT_EQ(leaf.block, leaf.triangles + leaf.quads > 0 ? 1 : 0);
      EXPECT_LE(leaf.wanted, leaf.level);
    }
    EXPECT_EQ(triangles, std::ssize(made.mesh.triangles));
    EXPECT_EQ(quads, std::ssize(made.mesh.quads));
    EXPECT_EQ(world().sum(std::ssize(made.tree.leaves)), made.report.leaves);
  }
}

/// The square of a leaf and half an edge round it: corners that snap move less.
Box surroundings(const TreeAttributes& tree, const LeafRecord& leaf) {
  const double unit = std::ldexp(tree.tree_edge, -30), edge = std::ldexp(tree.tree_edge, -leaf.level);
  const Point low{tree.root_x + tree.tree_edge * leaf.tree_x + unit * leaf.x,
                  tree.root_y + tree.tree_edge * leaf.tree_y + unit * leaf.y};
  return {low - Point{edge / 2, edge / 2}, low + Point{1.5 * edge, 1.5 * edge}};
}

TEST(BuildMesh, CellsLieInTheLeavesThatCountThem) {
  const MeshResult made = build_mesh(world(), pentagon(), sized(0.02, 0.2));
  const Mesh& mesh = made.mesh;
  auto triangle = mesh.triangles.begin();
  auto quad = mesh.quads.begin();
  const auto expect_within = [&mesh](const Box& box, const auto& cell) {
    for (const NodeId node : cell) EXPECT_TRUE(box.contains(mesh.point(node)));
  };
  for (const LeafRecord& leaf : made.tree.leaves) {
    const Box box = surroundings(made.tree.attributes, leaf);
    for (std::int32_t i = 0; i < leaf.triangles; ++i) expect_within(box, *triangle++);
    for (std::int32_t i = 0; i < leaf.quads; ++i) expect_within(box, *quad++);
  }
}

TEST(BuildMesh, BoundaryEdgesLieInTheLeavesThatAreNamed) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshOptions options = sized(0.02, 0.2);
    options.type = type;
    const MeshResult made = build_mesh(world(), pentagon(), options);
    ASSERT_EQ(made.edge_leaves.size(), 1U);
    const std::vector<std::int32_t>& leaves = made.edge_leaves[0];
    const auto& edges = made.mesh.boundaries[0].edges;
    ASSERT_EQ(leaves.size(), edges.size());
    EXPECT_TRUE(std::ranges::is_sorted(leaves));
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const Box box = surroundings(made.tree.attributes, made.tree.leaves[leaves[e]]);
      for (const NodeId node : edges[e]) EXPECT_TRUE(box.contains(made.mesh.point(node)));
    }
  }
}

TEST(BuildMesh, RefusesMoreCellsThanAreAllowed) {
  MeshOptions options = sized(0.01, 0.2);
  options.limit.cells = 100;
  try {
    build_mesh(world(), pentagon(), options);
    FAIL();
  } catch (const TooManyCells& refusal) {
    const std::string text = refusal.what();
    EXPECT_NE(text.find("--max-cells allows 100"), std::string::npos) << text;
    EXPECT_NE(text.find("boundary.wall.spacing"), std::string::npos) << text;
  }
  options.limit = {};
  options.limit.bytes = 1e6;
  EXPECT_THROW(build_mesh(world(), pentagon(), options), TooManyCells);
}

/// One leaf of the finest level in a corner, as adaptation or layers ask for.
std::vector<SplitDemand> deep_split() {
  if (!world().is_root()) return {};
  return {{{0, 0, 9}, (1U << 9) - 1}};
}

/// What is said of a mesh that these splits make too large.
std::string refusal_of(const DemandedSplits& demanded) {
  MeshOptions options = sized(0.25, 0.25);
  options.limit.cells = 60;
  try {
    build_mesh(world(), unit_square(), options, demanded);
  } catch (const TooManyCells& refusal) {
    return refusal.what();
  }
  ADD_FAILURE() << "it was meshed";
  return {};
}

TEST(BuildMesh, BlamesAdaptationWhereTheCaseAloneWouldFit) {
  const std::string text = refusal_of(DemandedSplits(world(), deep_split()));
  EXPECT_NE(text.find("reduce adapt.max_nodes"), std::string::npos) << text;
}

TEST(BuildMesh, BlamesLayersWhereTheyHaveAskedForSmallerLeaves) {
  const std::string text = refusal_of(DemandedSplits(world(), deep_split(), DemandedSplits{}));
  EXPECT_NE(text.find("use fewer or thinner layers"), std::string::npos) << text;
  EXPECT_EQ(text.find("adapt"), std::string::npos) << text;
}

TEST(MeshEstimate, IsNearTheMesh) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshOptions options = sized(0.005, 0.2);
    options.type = type;
    const MeshEstimate estimate = estimate_mesh(pentagon(), options, {});
    const MeshResult made = build_mesh(world(), pentagon(), options);
    const auto cells = static_cast<double>(made.tree.attributes.triangles + made.tree.attributes.quads);
    EXPECT_NEAR(std::log(estimate.cells / cells), 0, std::log(1.5));
    EXPECT_NEAR(estimate.leaves / static_cast<double>(made.report.leaves), 1, 0.2);
  }
}

TEST(MeshEstimate, TheScarcerOfCellsAndMemoryCounts) {
  const MeshEstimate estimate{100, 120, 5000, 1000};
  EXPECT_EQ(total_bytes(estimate, 3), 8000);
  EXPECT_EQ(share_of({}, estimate), 0);
  EXPECT_EQ(share_of({60, MeshLimit::none, 1}, estimate), 2);
  EXPECT_EQ(share_of({60, 2000, 3}, estimate), 4);
}

TEST(MeshEstimate, IsToldInRoundNumbers) {
  EXPECT_EQ(text_of_bytes(1000 * 0x1p20), "1000 MiB");
  EXPECT_EQ(text_of_bytes(1.5 * 0x1p30), "1.5 GiB");
  EXPECT_EQ(text_of_bytes(3 * 0x1p40), "3 TiB");
  EXPECT_EQ(text_of_cells(12344), "12340");
  EXPECT_EQ(text_of_cells(1234567), "1.2e+06");
}

}  // namespace
}  // namespace quadloop
