// What a user is told of layers, and that the same is kept with the mesh.
#include "mesher/layers/layer_report.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "generate/generate.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

constexpr double thickness = 0.01 * (1.5 * 1.5 * 1.5 * 1.5 - 1) / 0.5;  // of four layers
const LayerSpec four{0.01, 1.5, 1.5, 4, 1};

/// A channel from x = 0 to 4, as wide as `gap`, with layers below and, if wanted, above.
MeshInput channel(double gap, bool above) {
  Boundary floor{"floor", 0.2, 30, "wall"}, ceiling{"ceiling", 0.2, 30, "wall"},
      ends{"ends", 0.2, 30, "none"};
  floor.layers = four;
  if (above) ceiling.layers = four;
  MeshInput input{{{floor, ends, ceiling},
                   {{0, 0}, {4, 0}, {4, gap}, {0, gap}},
                   {0, 4},
                   {BoundaryId{0}, BoundaryId{1}, BoundaryId{2}, BoundaryId{1}}},
                  {},
                  {},
                  0};
  input.mesh.size.min = 0.005;
  input.mesh.size.max = 0.25;
  return input;
}

TEST(LayerReport, TellsOfEachBoundaryWhatWasAskedAndReached) {
  const GeneratedMesh made = generate_mesh(world(), channel(2, true));
  ASSERT_EQ(made.layers.size(), 2U);
  EXPECT_EQ(made.layers[0].boundary, "floor");
  EXPECT_EQ(made.layers[1].boundary, "ceiling");
  for (const BoundaryLayerReport& row : made.layers) {
    EXPECT_EQ(row.asked, 4);
    EXPECT_EQ(row.reached, 4);
    EXPECT_GT(row.columns, 20);
    EXPECT_NEAR(row.first_least, 0.01, 1e-12);
    EXPECT_NEAR(row.first_median, 0.01, 1e-12);
    EXPECT_NEAR(row.growth_least, 1.5, 1e-9);
    EXPECT_NEAR(row.thickness_asked, thickness, 1e-12);
    EXPECT_EQ(row.share_least, 1);
    EXPECT_EQ(row.share_full, 1);
  }
  EXPECT_TRUE(warnings_of(made.layers).empty());
  EXPECT_EQ(made.layers[0].columns, made.layers[1].columns) << "mirror images";
}

TEST(LayerReport, WarnsOfTheThinnestFirstAndCountsTheRest) {
  LayerReport report(8);
  for (int i = 0; i < 8; ++i) {
    report[i].boundary = "islet_" + std::to_string(i);
    report[i].share_least = i == 7 ? 0.9 : 0.4 - 0.05 * i;
  }
  const std::vector<std::string> warnings = warnings_of(report);
  ASSERT_EQ(warnings.size(), 6U);
  EXPECT_TRUE(warnings[0].starts_with("boundary 'islet_6'")) << warnings[0];
  EXPECT_TRUE(warnings[4].starts_with("boundary 'islet_2'")) << warnings[4];
  EXPECT_TRUE(warnings[5].ends_with("on 2 more of the boundaries; the table at the end lists them all"))
      << warnings[5];
}

TEST(LayerReport, HasARowForEachStrip) {
  MeshInput input = channel(2, false);
  input.lines = {{{}, {{1, 1}, {3, 1}}, 0, 0.05, four}};
  const GeneratedMesh made = generate_mesh(world(), input);
  ASSERT_EQ(made.layers.size(), 2U);
  const BoundaryLayerReport& line = made.layers[1];
  EXPECT_EQ(line.boundary, "layer_line");
  EXPECT_EQ(line.asked, 4);
  EXPECT_EQ(line.reached, 4);
  EXPECT_EQ(line.columns, made.result.mesh.strips.at(0).columns());
  EXPECT_NEAR(line.first_asked, 0.01, 1e-12);
  EXPECT_NEAR(line.first_least, 0.01, 1e-12);
  EXPECT_LT(line.first_median, 0.02);
  EXPECT_NEAR(line.growth_asked, 1.5, 1e-12);
  EXPECT_NEAR(line.growth_least, 1, 1e-9) << "even rows at the ends";
  EXPECT_NEAR(line.thickness_asked, thickness, 1e-12);
  EXPECT_NEAR(line.share_least, 1, 1e-12);
  EXPECT_EQ(line.share_full, 1);
  EXPECT_EQ(line.least.y, 1);
}

/// The rows of a wake open downstream until they are equally high, which is no fault to be warned of.
TEST(LayerReport, NamesTheGrowthAtTheThinnestPlaceOfAWake) {
  const LayerSpec eight{0.01, 1.5, 1.5, 8, 1};
  const PlacedLine line{0, 0, {{0, 0}, {6, 0}}, 0.1, eight, "wake"};
  const double pinched = 0.4 * layers_thickness(eight);
  const BoundaryLayerReport wake =
      report_strip(layer_strip(line, WakeRoot{0, {0.01, pinched}, {0.01, -pinched}, {}, 0.04}));
  EXPECT_NEAR(wake.growth_least, 1, 1e-9);
  EXPECT_NEAR(wake.share_least, 0.4, 0.02);
  EXPECT_GT(wake.growth_at_least, 1.2);
  const std::vector<std::string> warnings = warnings_of({wake});
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("with the growth ratio 1.2"), std::string::npos) << warnings[0];
}

TEST(LayerReport, WarnsWhereLessThanHalfIsReached) {
  const GeneratedMesh made = generate_mesh(world(), channel(0.1, true));
  ASSERT_EQ(made.layers.size(), 2U);
  const BoundaryLayerReport& floor = made.layers[0];
  EXPECT_EQ(floor.reached, 4) << "they get thinner, not fewer";
  EXPECT_LT(floor.share_least, 0.5);
  EXPECT_EQ(floor.share_full, 0);
  EXPECT_LT(floor.growth_least, 1.5);
  EXPECT_EQ(floor.least.y, 0);
  const std::vector<std::string> warnings = warnings_of(made.layers);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_NE(warnings[0].find("boundary 'floor': near ("), std::string::npos) << warnings[0];
  for (const std::string& warning : warnings)
    EXPECT_EQ(std::ranges::count(made.result.report.warnings, warning), 1) << warning;
}

TEST(LayerReport, WarnsOfLeavesThatMinKeepsAboveTheLastLayer) {
  MeshInput input = channel(2, true);
  const LayerFront front = layer_front(input.geometry);
  const double last = 0.01 * 1.5 * 1.5 * 1.5;
  EXPECT_TRUE(size_warnings(front, 1.99 * last).empty());
  const std::vector<std::string> warnings = size_warnings(front, 2.01 * last);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_TRUE(warnings[0].starts_with("boundary 'floor': its last layer is 0.0338 high near ("))
      << warnings[0];
  EXPECT_NE(warnings[0].find("requires cells of at most 0.0675 beside it, but spacing.min = 0.0678"),
            std::string::npos)
      << warnings[0];
  input.mesh.size.min = 2.01 * last;
  const GeneratedMesh made = generate_mesh(world(), input);
  for (const std::string& warning : warnings)
    EXPECT_EQ(std::ranges::count(made.result.report.warnings, warning), 1) << warning;
}

/// Warnings of a body in a box, with a wake from its blunt edge of twice this height at x = 1; the path may
/// be empty.
std::vector<std::string> warnings_of_wake(double half, std::vector<Point> path) {
  Boundary box{"box", 0.5, 30, "none"}, body{"body", 0.1, 30, "wall"};
  body.layers = four;
  const std::vector<Point> points{{-4, -4}, {4, -4},   {4, 4},     {-4, 4},   {-1, 0.3},
                                  {0, 0.3}, {1, half}, {1, -half}, {0, -0.3}, {-1, -0.3}};
  std::vector<BoundaryId> of_segment(10, BoundaryId{1});
  std::fill_n(of_segment.begin(), 4, BoundaryId{0});
  const Geometry geometry({box, body}, points, {0, 4, 10}, of_segment);
  return size_warnings(layer_front(geometry, {}, {{{"body"}, std::move(path), 1.5, 0.1, {}, "case.toml:7"}}),
                       0);
}

TEST(LayerReport, WarnsOfAWakeThatTurnsAtItsEdge) {
  EXPECT_TRUE(warnings_of_wake(0.05, {{2, 0.25}}).empty()) << "14 degrees";
  EXPECT_TRUE(warnings_of_wake(0.05, {{1.5, 0.1}, {2, 0.3}, {2.5, 0.6}}).empty()) << "a gradual bend";
  const std::vector<std::string> sharp = warnings_of_wake(0.05, {{2, 0.5}});
  ASSERT_EQ(sharp.size(), 1U);
  EXPECT_TRUE(
      sharp[0].starts_with("case.toml:7: wake turns by 27 degrees from the direction of the trailing "
                           "edge near (1.01, 0)"))
      << sharp[0];
}

TEST(LayerReport, WarnsOfABaseWithoutLayers) {
  EXPECT_TRUE(warnings_of_wake(0.05, {}).empty());
  const std::vector<std::string> narrow = warnings_of_wake(0.005, {});
  ASSERT_EQ(narrow.size(), 1U);
  EXPECT_TRUE(narrow[0].starts_with(
      "case.toml:7: the blunt trailing edge at (1, 0), where wake begins, is too narrow"))
      << narrow[0];
  EXPECT_NE(narrow[0].find("high instead of first = 0.01"), std::string::npos) << narrow[0];
}

/// The warning about small cells beside the wake of a wedge whose edge turns by 168.579 degrees.
std::string warning_beside_wake(double corner) {
  Boundary box{"box", 0.5, 30, "none"}, body{"body", 0.1, corner, "wall"};
  body.layers = four;
  std::vector<BoundaryId> of_segment(7, BoundaryId{1});
  std::fill_n(of_segment.begin(), 4, BoundaryId{0});
  const Geometry geometry({box, body}, {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}, {-1, 0.2}, {1, 0}, {-1, -0.2}},
                          {0, 4, 7}, of_segment);
  constexpr double min = 10;  // above every cell
  const LayerFront front = layer_front(geometry, {}, {{{"body"}, {}, 1.5, 0.1, {}, "case.toml:7"}});
  for (const std::string& warning : size_warnings(front, min)) {
    if (warning.starts_with("case.toml:7: the layers of wake require cells")) return warning;
  }
  return "none";
}

TEST(LayerReport, WarnsOfAnEdgeThatIsNoFeaturePoint) {
  const std::string of_corner = warning_beside_wake(30), of_point = warning_beside_wake(180);
  EXPECT_TRUE(of_corner.ends_with("; reduce spacing.min, or use thicker or fewer layers")) << of_corner;
  EXPECT_NE(of_point.find("; make corner = 180 of boundary 'body' smaller than 168.579"), std::string::npos)
      << of_point;
}

TEST(LayerReport, IsEmptyWithoutLayersAndCountsOnlyThoseThatAsk) {
  EXPECT_EQ(generate_mesh(world(), channel(2, false)).layers.size(), 1U);
  MeshInput plain = channel(2, false);
  plain.geometry = {
      {{"floor", 0.2, 30, "wall"}}, {{0, 0}, {4, 0}, {4, 2}, {0, 2}}, {0, 4}, std::vector(4, BoundaryId{0})};
  const GeneratedMesh made = generate_mesh(world(), plain);
  EXPECT_TRUE(made.layers.empty());
  EXPECT_EQ(made.result.mesh.boundaries[0].layers, WallLayers{});
}

TEST(LayerReport, TheMeshKeepsTheNumberOfLayersAndTheirThickness) {
  const Mesh mesh = generate_mesh(world(), channel(2, false)).result.mesh;
  EXPECT_EQ(mesh.boundaries[0].layers.count, 4);
  EXPECT_NEAR(mesh.boundaries[0].layers.thickness, thickness, 1e-12);
  EXPECT_EQ(mesh.boundaries[1].layers, WallLayers{});
  EXPECT_EQ(mesh.boundaries[2].layers, WallLayers{});
}

TEST(LayerReport, IsTheSameOnAnyNumberOfRanks) {
  const Communicator alone(MPI_COMM_SELF);
  const LayerReport one = generate_mesh(alone, channel(0.4, true)).layers;
  const LayerReport many = generate_mesh(world(), channel(0.4, true)).layers;
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t b = 0; b < one.size(); ++b) {
    EXPECT_EQ(one[b].columns, many[b].columns);
    EXPECT_EQ(one[b].first_least, many[b].first_least);
    EXPECT_EQ(one[b].first_median, many[b].first_median);
    EXPECT_EQ(one[b].growth_least, many[b].growth_least);
    EXPECT_EQ(one[b].share_least, many[b].share_least);
    EXPECT_EQ(one[b].share_full, many[b].share_full);
    EXPECT_EQ(one[b].least, many[b].least);
  }
}

TEST(LayerReport, TheEstimateCountsTheirCells) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshInput input = channel(2, true);
    input.mesh.type = type;
    const GeneratedMesh made = generate_mesh(world(), input);
    const MeshEstimate& estimate = made.result.report.estimate;
    const std::int64_t columns = made.layers[0].columns + made.layers[1].columns - 2;
    const auto in_layers = static_cast<double>(4 * columns * (type == MeshType::delaunay ? 2 : 1));
    EXPECT_LT(std::abs(std::log(estimate.layer_cells / in_layers)), std::log(1.5));
    EXPECT_GT(estimate.cells, estimate.layer_cells);
  }
}

}  // namespace
}  // namespace quadloop
