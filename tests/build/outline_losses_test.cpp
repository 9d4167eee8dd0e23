// What a mesh may lose of its outline, and what is said of it; islands; what asks for cells.
#include "mesher/build/outline_losses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "mesher/base/error.hpp"
#include "mesher/build/cell_demands.hpp"
#include "mesher/build/islands.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

std::vector<Point> box(Point low, double width, double height) {
  return {low, low + Point{width, 0}, low + Point{width, height}, low + Point{0, height}};
}

/// Loops, each a boundary of its own: b0, b1, ...
Geometry loops(const std::vector<std::vector<Point>>& given) {
  std::vector<Boundary> boundaries;
  std::vector<Point> points;
  std::vector<std::int32_t> starts{0};
  std::vector<BoundaryId> of_segment;
  for (const auto& loop : given) {
    const auto number = size32(boundaries);
    boundaries.push_back({"b" + std::to_string(number)});
    points.insert(points.end(), loop.begin(), loop.end());
    starts.push_back(size32(points));
    of_segment.resize(points.size(), BoundaryId{number});
  }
  return {boundaries, points, starts, of_segment};
}

std::vector<Point> reversed(std::vector<Point> loop) {
  std::reverse(loop.begin(), loop.end());
  return loop;
}

/// The unit square in cells, on all ranks.
Mesh square_mesh() {
  const Mesh whole = test::Grid{8, {1, 1}, true}.mesh();
  return scatter_mesh(world(), whole, space_filling_order(whole));
}

/// With one boundary, as an outline of one loop has.
Mesh square_in_one_boundary() {
  Mesh mesh = square_mesh();
  std::vector<BoundaryEdges>& boundaries = mesh.boundaries;
  for (std::size_t b = 1; b < boundaries.size(); ++b)
    boundaries[0].edges.insert(boundaries[0].edges.end(), boundaries[b].edges.begin(),
                               boundaries[b].edges.end());
  boundaries.resize(1);
  return mesh;
}

TEST(Islands, SmallLoopsGoWithTheirArea) {
  const Geometry given =
      loops({box({0, 0}, 4, 4), reversed(box({1, 1}, 0.1, 0.2)), reversed(box({2, 1}, 0.1, 0.5))});
  MeshReport report;
  const Geometry kept = without_small_islands(given, 0.3, report);
  EXPECT_EQ(kept.loop_count(), 2);
  EXPECT_EQ(report.islands_dropped, 1);
  EXPECT_NEAR(report.area_dropped, -0.02, 1e-15);
  EXPECT_EQ(report.boundaries_vanished, (std::vector<std::string>{"b1"}));
  ASSERT_EQ(report.warnings.size(), 1U);
  EXPECT_TRUE(report.warnings[0].starts_with("boundary b1: a loop near (1.05, 1.1) is smaller"))
      << report.warnings[0];
  EXPECT_EQ(kept.boundary(kept.boundary_of(4)).name, "b2");
}

TEST(Islands, ALoopAsLargeAsTheSmallestLeafStays) {
  const Geometry given = loops({box({0, 0}, 4, 4), reversed(box({1, 1}, 0.25, 0.1))});
  MeshReport report;
  EXPECT_EQ(without_small_islands(given, 0.25, report).digest(), given.digest());
  EXPECT_EQ(report.islands_dropped, 0);
  EXPECT_EQ(without_small_islands(given, 0.26, report).loop_count(), 1);
}

TEST(Islands, WhereNoLoopRemainsThereIsNoDomain) {
  MeshReport report;
  EXPECT_NE(test::refusal_text([&] {
              without_small_islands(loops({box({3, 3}, 1, 1)}), 2, report);
            }).find("boundary b0 near (3.5, 3.5)"),
            std::string::npos);
}

Chain chain_of(const std::string& name, std::vector<Point> points) {
  return {name, false, std::move(points), {}};
}

/// Squares of side 1 with these lower left corners, each a block, in a hole of a block of their own if
/// `around`.
std::int64_t regions_of_squares(const std::vector<Point>& corners, bool around = false) {
  std::vector<Chain> chains;
  AssembleOptions options;
  const auto add = [&](const std::string& name, std::vector<Point> points) {
    chains.push_back(chain_of(name, std::move(points)));
    options.blocks.push_back({name, {}, name, {}, "case"});
  };
  if (around) add("around", box({-10, -10}, 20, 20));
  for (const Point corner : corners) add("square" + std::to_string(chains.size()), box(corner, 1, 1));
  Warnings warnings;
  return regions_of(assemble(std::move(chains), options, warnings));
}

TEST(Regions, ExtendOverSeveralBlocks) {
  EXPECT_EQ(regions_of_squares({{0, 0}}), 1);
  EXPECT_EQ(regions_of_squares({{0, 0}, {1, 0}, {1, 1}}), 1);
  EXPECT_EQ(regions_of_squares({{0, 0}, {1, 1}}), 2) << "which touch at a point";
  EXPECT_EQ(regions_of_squares({{0, 0}, {3, 0}, {3, 1}}), 2);
  EXPECT_EQ(regions_of_squares({{0, 0}, {3, 0}, {3, 1}}, true), 1);
  EXPECT_EQ(regions_of_squares({{0, 0}, {1, 0}, {2, 0}, {0, 1}, {2, 1}, {0, 2}, {1, 2}, {2, 2}}), 1)
      << "around a hole";
}

TEST(Regions, AreSeparatedByBaffles) {
  const auto with_baffle = [](std::vector<Point> path) {
    AssembleOptions options;
    options.lines = {{"plate", {}, std::move(path), true, "case"}};
    Warnings warnings;
    return regions_of(assemble({chain_of("box", box({0, 0}, 4, 4))}, options, warnings));
  };
  EXPECT_EQ(with_baffle({{1, 1}, {3, 1}, {2.9, 2.7}}), 1);
  EXPECT_EQ(with_baffle({{0, 1}, {3, 1.1}}), 1);
  EXPECT_EQ(with_baffle({{0, 1}, {4, 1}}), 2);
  EXPECT_EQ(with_baffle({{1, 1}, {3, 1}, {2, 3}, {1, 1}}), 2);
  EXPECT_EQ(regions_of(loops({box({0, 0}, 9, 9), reversed(box({1, 1}, 7, 7)), box({2, 2}, 1, 1)})), 2);
}

TEST(OutlineLosses, BoundariesWithoutEdgesVanish) {
  Mesh mesh = square_in_one_boundary();
  const Geometry geometry = loops({box({0, 0}, 1, 1), reversed(box({0.5, 0.5}, 0.001, 0.002))});
  mesh.boundaries.front().name = "b0";
  mesh.boundaries.push_back({"b1", "none", {}});
  MeshReport report;
  const std::string refusal =
      test::refusal_text([&] { report_losses(world(), geometry, mesh, false, report); });
  EXPECT_TRUE(refusal.starts_with("boundary 'b1' near (0.5005, 0.501), 0.001 wide and 0.002 high, "))
      << refusal;
  report_losses(world(), geometry, mesh, true, report);
  EXPECT_EQ(report.boundaries_vanished, (std::vector<std::string>{"b1"}));
}

TEST(OutlineLosses, KeptCornersThatAreNoNodesAreCounted) {
  MeshReport none, report;
  report_losses(world(), loops({box({0, 0}, 1, 1)}), square_in_one_boundary(), false, none);
  EXPECT_EQ(none.corners_lost, 0);
  EXPECT_TRUE(none.warnings.empty());
  report.warnings = {"of an island"};
  report_losses(world(), loops({{{0, 0}, {1, 0}, {1.01, 0.4}, {1.0, 1.02}, {0, 1}}}),
                square_in_one_boundary(), false, report);
  EXPECT_EQ(report.corners_lost, 1) << "(1.01, 0.4) is no corner of 30 degrees";
  ASSERT_EQ(report.warnings.size(), 2U);
  EXPECT_NE(report.warnings[0].find("1 of 4 feature points is no node"), std::string::npos)
      << report.warnings[0];
}

TEST(OutlineLosses, AShapeThatEdgesHardlyShowIsTold) {
  MeshReport near, far;
  report_losses(world(), loops({box({0, 0}, 1, 1.04)}), square_in_one_boundary(), false, near);
  report_losses(world(), loops({box({0, 0}, 1, 1.2)}), square_in_one_boundary(), false, far);
  const auto told = [](const MeshReport& report) {
    return std::ranges::count_if(report.warnings, [](const std::string& warning) {
      return warning.starts_with(
          "boundary 'b0' near (0.5, 0.6): the boundary edges of the mesh enclose 17 percent less");
    });
  };
  EXPECT_EQ(told(far), 1);
  EXPECT_EQ(
      std::ranges::count_if(near.warnings, [](const std::string& w) { return w.find("enclose") != w.npos; }),
      0);
}

TEST(RequireArea, TheMeshMayMissAFewHundredths) {
  const Mesh mesh = square_in_one_boundary();
  EXPECT_NO_THROW(require_area(world(), loops({box({0, 0}, 1, 1.04)}), 0, mesh));
  const std::string refusal = test::refusal_text([&] {
    require_area(world(), loops({box({0, 0}, 1, 1.2)}), 0, mesh);
  });
  EXPECT_NE(refusal.find("differs by 16.7 percent"), std::string::npos) << refusal;
  EXPECT_NE(test::refusal_text([&] {
              require_area(world(), loops({box({0, 0}, 1, 1.2)}), 0, mesh, true);
            }).find("during smoothing"),
            std::string::npos);
}

TEST(RequireArea, CountsWithAndWithoutWhatWasDropped) {
  Mesh mesh = square_in_one_boundary();
  mesh.boundaries.push_back({"b1", "none", {}});
  const Geometry with_island = loops({box({0, 0}, 1, 1), reversed(box({0.5, 0.5}, 0.2, 0.2))});
  EXPECT_NO_THROW(require_area(world(), with_island, -0.04, mesh))
      << "4 % are missed, of which all are known";
  EXPECT_THROW(require_area(world(), with_island, 0.06, mesh), InputError);
}

TEST(AreaOfLoop, IsSignedAndExactFarFromTheOrigin) {
  EXPECT_EQ(area_of_loop(loops({box({0, 0}, 3, 2)}), 0), 6);
  EXPECT_EQ(area_of_loop(loops({reversed(box({0, 0}, 3, 2))}), 0), -6);
  EXPECT_EQ(area_of_loop(loops({box({0x1p40, -0x1p40}, 3, 2)}), 0), 6);
}

SizeSettings settings() {
  SizeSettings all;
  all.size.min = 0.01;
  all.size.max = 0.5;
  all.size.curvature = 10;
  all.size.gap = 3;
  all.size.sources = {{Box{{0, 0}, {1, 1}}, 0.3, "case.toml:5"}, {Box{{0, 0}, {1, 1}}, 0.2}};
  all.boundaries = {{"a", 0.1}, {"b", 0.05}, {"c", 0.1}, {"d", 0}};
  return all;
}

TEST(CellDemands, NameEachSettingOnce) {
  std::vector<std::string> keys;
  for (const CellDemand& demand : cell_demands(settings(), loops({box({0, 0}, 8, 4)})))
    keys.push_back(demand.key);
  EXPECT_EQ(keys,
            (std::vector<std::string>{"spacing.max", "spacing.curvature", "spacing.gap", "boundary.b.spacing",
                                      "boundary.a.spacing (and 1 more)", "spacing of the [[source]]",
                                      "spacing of the [[source]] at case.toml:5", "spacing.min"}));
}

TEST(CellDemands, SetAndLiftWhatTheyName) {
  const SizeSettings given = settings();
  std::set<std::string> keys;
  for (const CellDemand& demand : cell_demands(given, loops({box({0, 0}, 8, 4)}))) {
    keys.insert(demand.key);
    SizeSettings set = given, lifted = given;
    demand.set(set, 0.7);
    demand.lift(lifted);
    if (demand.key == "spacing.max") {
      EXPECT_EQ(set.size.max, 0.7);
      EXPECT_EQ(lifted.size.max, 8) << "the longer side of the outline";
    } else if (demand.key == "spacing.gap") {
      EXPECT_FALSE(demand.is_size);
      EXPECT_EQ(lifted.size.gap, 0);
    } else if (demand.key == "boundary.a.spacing (and 1 more)") {
      EXPECT_EQ(set.boundaries[0].spacing, 0.7);
      EXPECT_EQ(set.boundaries[2].spacing, 0.7);
      EXPECT_EQ(set.boundaries[1].spacing, 0.05);
    } else if (demand.key == "spacing.min") {
      EXPECT_EQ(set.size.min, 0.7);
      EXPECT_EQ(set.size.max, 0.7) << "no less than min";
      EXPECT_EQ(lifted.boundaries[3].spacing, 8) << "that asked for its own points' spacing";
      EXPECT_EQ(lifted.boundaries[0].spacing, 0.1);
    } else if (demand.key == "spacing of the [[source]]") {
      EXPECT_EQ(demand.value, 0.2);
      EXPECT_EQ(set.size.sources[1].spacing, 0.7);
      EXPECT_EQ(set.size.sources[0].spacing, 0.3);
    }
  }
  for (const char* key : {"spacing.max", "spacing.gap", "boundary.a.spacing (and 1 more)", "spacing.min",
                          "spacing of the [[source]]"})
    EXPECT_TRUE(keys.contains(key)) << key;
}

TEST(CellDemands, OfManyBoundariesTheSmallestCount) {
  SizeSettings many;
  many.size.min = many.size.max = 1;
  for (int i = 0; i < 50; ++i) many.boundaries.push_back({"b" + std::to_string(i), 50.0 - i});
  const auto demands = cell_demands(many, loops({box({0, 0}, 8, 4)}));
  EXPECT_EQ(demands.size(), 1U + 16 + 1);
  EXPECT_EQ(demands[1].value, 1);
  EXPECT_EQ(demands[16].value, 16);
}

TEST(WithBoundaries, KeepsTheOutline) {
  const Geometry given = loops({box({0, 0}, 4, 4), reversed(box({1, 1}, 1, 1))});
  std::vector<Boundary> boundaries(given.boundaries().begin(), given.boundaries().end());
  EXPECT_EQ(with_boundaries(given, boundaries).digest(), given.digest());
  boundaries[1].spacing = 0.125;
  const Geometry other = with_boundaries(given, boundaries);
  EXPECT_EQ(other.spacing_of(5), 0.125);
  EXPECT_EQ(other.spacing_of(0), 4);
}

}  // namespace
}  // namespace quadloop
