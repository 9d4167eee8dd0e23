#include "mesher/mesh/check/layer_statistics.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>

#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/layered_strip.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::LayeredStrip;
using test::world;

/// Those of a mesh, distributed over the ranks.
std::vector<LayerStatistics> statistics_of(const Mesh& whole) {
  const Mesh mesh = scatter_mesh(world(), whole, own_order(whole));
  const HaloMesh halo(world(), mesh);
  return layer_statistics(world(), mesh, halo, layer_places(world(), mesh));
}

TEST(LayerStatistics, MeasureColumnsOfQuadsAndOfTriangles) {
  for (const bool triangles : {false, true}) {
    const LayeredStrip strip{.triangles = triangles};
    const std::vector<LayerStatistics> statistics = statistics_of(strip.mesh());
    ASSERT_EQ(statistics.size(), 1U);
    const LayerStatistics& wall = statistics[0];
    EXPECT_EQ(wall.boundary, "wall");
    EXPECT_EQ(wall.count, 3);
    EXPECT_EQ(wall.columns, 7) << "those on symmetry too";
    for (const double first : {wall.first.least, wall.first.median, wall.first.largest})
      EXPECT_NEAR(first, 0.1, 1e-15);
    EXPECT_NEAR(wall.growth.least, 2, 1e-12);
    EXPECT_NEAR(wall.growth.largest, 2, 1e-12);
    EXPECT_NEAR(wall.thickness.median, 0.7, 1e-15);
    EXPECT_NEAR(wall.asked, 0.7, 1e-15);
  }
}

TEST(LayerStatistics, OfAPartLeaveOutColumnsAtItsBorder) {
  const LayeredStrip strip{};
  Mesh part = strip.mesh();  // ends to the right in a step, as if the cells beyond were another part's
  std::erase_if(part.quads, [&](const auto& nodes) {
    return nodes[0] == strip.node(5, 0) || nodes[0] == strip.node(5, 1) || nodes[0] == strip.node(4, 0);
  });
  std::erase_if(part.boundaries[1].edges, [&](const auto& edge) { return edge[0].value() >= 4; });
  std::erase_if(part.boundaries[3].edges,
                [&](const auto& edge) { return edge[0] == strip.node(6, 0) || edge[0] == strip.node(6, 1); });
  BoundaryEdges cut{"part_0002", "interface", {}};
  const std::vector<NodeId> along{strip.node(4, 0), strip.node(4, 1), strip.node(5, 1), strip.node(5, 2),
                                  strip.node(6, 2)};
  for (std::size_t i = 1; i < along.size(); ++i) cut.edges.push_back({along[i - 1], along[i]});
  part.boundaries.push_back(cut);
  const std::vector<LayerStatistics> statistics = statistics_of(part);
  ASSERT_EQ(statistics.size(), 1U);
  EXPECT_EQ(statistics[0].columns, 4);
  EXPECT_EQ(statistics[0].cut_columns, 1);
  EXPECT_NEAR(statistics[0].growth.least, 2, 1e-12);
  EXPECT_NEAR(statistics[0].thickness.least, 0.7, 1e-12);
  EXPECT_NEAR(statistics[0].thickness.largest, 0.7, 1e-12);
}

TEST(LayerStatistics, GoOnAlongOtherBoundariesButNotAlongABorderOfParts) {
  const LayeredStrip strip{};
  Mesh part = strip.mesh();
  EXPECT_EQ(statistics_of(part)[0].columns, 7);
  part.boundaries[2].name = "part_0007";  // what goes on straight from the wall
  const std::vector<LayerStatistics> statistics = statistics_of(part);
  EXPECT_EQ(statistics[0].columns, 4);
  EXPECT_EQ(statistics[0].cut_columns, 1) << "where the wall ends";
}

TEST(LayerStatistics, OfStripsAreMeasuredOnBothSidesOfTheirLine) {
  const LayeredStrip grid{6, 2, 2, false};
  Mesh mesh = grid.mesh();
  StripLayers strip{"wake", {1, 0.5}, false, 3, {}};
  for (std::int32_t i = 1; i <= 4; ++i) {
    for (std::int32_t j = 2; j <= 4; ++j) strip.nodes.push_back(mesh.global(grid.node(i, j)));
  }
  mesh.strips = {strip};
  mesh.points[grid.node(2, 4).value()].y += 0.25;
  mesh.points[grid.node(3, 2).value()].x += 0.1;  // that column leans
  const std::vector<LayerStatistics> statistics = statistics_of(mesh);
  ASSERT_EQ(statistics.size(), 2U);
  EXPECT_EQ(statistics[0].boundary, "wall");
  EXPECT_EQ(statistics[1].boundary, "wake");
  EXPECT_EQ(statistics[1].count, 1);
  EXPECT_EQ(statistics[1].columns, 4);
  EXPECT_NEAR(statistics[1].first.least, 1, 1e-12);
  EXPECT_NEAR(statistics[1].first.largest, 1.25, 1e-12);
  EXPECT_NEAR(statistics[1].thickness.largest, 1.25, 1e-12);
  EXPECT_EQ(statistics[1].asked, 0.5);
}

TEST(LayerStatistics, OfABluntEdgesStripBeginAtItsOuterLines) {
  const LayeredStrip grid{6, 3, 0, false};  // heights .1, .3, .7, 1.7, 2.7, 3.7
  Mesh mesh = grid.mesh();
  StripLayers strip{"wake", {1, 0.5}, false, 7, {}};
  for (std::int32_t i = 1; i <= 4; ++i) {
    for (std::int32_t j = 0; j <= 6; ++j) strip.nodes.push_back(mesh.global(grid.node(i, j)));
  }
  mesh.strips = {strip};
  const LayerStatistics wake = statistics_of(mesh).back();
  EXPECT_NEAR(wake.first.least, 0.1, 1e-12);
  EXPECT_NEAR(wake.first.largest, 1, 1e-12);
  EXPECT_NEAR(wake.thickness.largest, 1, 1e-12) << "the rows between are no layers of either side";
}

TEST(LayerStatistics, FirstHeightsAreNormalToTheWallAndSpreadIsSeen) {
  const LayeredStrip strip;
  Mesh mesh = strip.mesh();
  for (Point& p : mesh.points) p.x += 0.3 * p.y;  // columns tilt, all heights stay
  for (std::int32_t j = 1; j <= strip.layers; ++j) mesh.points[strip.node(3, j).value()].y *= 0.5;
  const LayerStatistics wall = statistics_of(mesh).at(0);
  EXPECT_NEAR(wall.first.least, 0.05, 1e-15);
  EXPECT_NEAR(wall.first.median, 0.1, 1e-15);
  EXPECT_NEAR(wall.first.largest, 0.1, 1e-15);
  EXPECT_NEAR(wall.thickness.largest, 0.7 * std::hypot(1, 0.3), 1e-12);
  EXPECT_LT(wall.thickness.least, 0.5);
}

TEST(LayerStatistics, AColumnGoesStraightOnThoughADiagonalBeShorter) {
  Mesh mesh = LayeredStrip{.triangles = true}.mesh();
  for (Point& p : mesh.points) p = {p.x + 1.8 * p.y, 2 * p.y};
  const LayerStatistics wall = statistics_of(mesh).at(0);
  EXPECT_NEAR(wall.growth.least, 2, 1e-9);
  EXPECT_NEAR(wall.growth.largest, 2, 1e-9);
  EXPECT_NEAR(wall.thickness.least, 0.7 * std::hypot(2, 1.8), 1e-12);
}

TEST(LayerStatistics, NothingWithoutLayers) {
  Mesh mesh = LayeredStrip{}.mesh();
  mesh.boundaries[1].layers = {};
  EXPECT_TRUE(statistics_of(mesh).empty());
}

TEST(QualityByLayers, CountsTheirCellsApart) {
  const LayeredStrip strip{.triangles = false};
  const Mesh mesh = scatter_mesh(world(), world().is_root() ? strip.mesh() : Mesh{},
                                 world().is_root() ? own_order(strip.mesh()) : MeshOrder{});
  const QualityByLayers by = quality_by_layers(world(), mesh, layer_places(world(), mesh));
  EXPECT_EQ(by.layers.counts.quads, 18);
  EXPECT_EQ(by.others.counts.quads, 18);
  EXPECT_NEAR(by.others.worst, 1, 1e-12) << "squares";
  EXPECT_NEAR(by.layers.worst, 0.2 / 1.01, 1e-12) << "a cell of 1 by 0.1";
}

}  // namespace
}  // namespace quadloop
