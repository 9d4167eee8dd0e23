// Sizes of cells from a case and its geometry, and warnings about requests that are not met.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesher/geometry/assemble/assemble.hpp"
#include "tests/quadloop/case/settings_fixture.hpp"

namespace quadloop {
namespace {

class SizeSettings : public test::SettingsFixture {};

TEST_F(SizeSettings, SizesFollowTheGeometryWhereTheyAreNotGiven) {
  const Settings open = read("far_field = 16\n[boundary.box]\nspacing = 0.125\n");
  const MeshOptions options = mesh_options(open, load(open));
  EXPECT_EQ(options.size.max, 2);
  EXPECT_EQ(options.size.min, 0.0625);
  const Settings coarse = read("far_field = 16\n[spacing]\nmin = 5\n");
  EXPECT_EQ(mesh_options(coarse, load(coarse)).size.max, 5);
  const Settings fine = read("far_field = 16\n[spacing]\nmax = 0.5\n");
  EXPECT_EQ(mesh_options(fine, load(fine)).size.min,
            0.25);  // sizes halve: so there is a leaf no larger than max
}

TEST_F(SizeSettings, TheRootMeetsTheSmallestRequestOfABoundaryElseMax) {
  const auto aim = [&](const std::string& text) {
    const Settings settings = read("far_field = 16\n" + text);
    return mesh_options(settings, load(settings)).size.aim;
  };
  const std::string box = "[boundary.box]\nspacing = 0.3\n",
                    farfield = "[boundary.farfield]\nspacing = 0.7\n";
  EXPECT_EQ(aim("[spacing]\nmax = 0.9\n" + box + farfield), 0.3);
  const std::string layers = "layers = { first = 0.1, growth = 1.2, count = 2 }\n";
  EXPECT_EQ(aim(box + layers), 0.24) << "twice the last layer";
  EXPECT_EQ(aim("[boundary.box]\n" + layers + farfield), 0.24);
  EXPECT_EQ(aim("[boundary.box]\nspacing = 0.2\n" + layers), 0.2);
  EXPECT_EQ(aim("[spacing]\nmax = 0.9\n" + farfield), 0.7);
  EXPECT_EQ(aim("[spacing]\nmax = 0.9\n"), 0.9);
  EXPECT_EQ(aim("[spacing]\nmin = 0.4\nmax = 0.9\n" + box), 0.4) << "no smaller than min";
  EXPECT_EQ(aim("[spacing]\nmax = 0.2\n" + box), 0.2) << "no larger than max";
  EXPECT_EQ(aim("[[source]]\ndisc = [9, 9, 1]\nspacing = 0.11\n"), 0.11) << "the smallest of all";
}

TEST_F(SizeSettings, CellsOfARoundFarFieldAreBetweenTheRequestAndTheEdgesOnTheCircle) {
  for (const std::string shape : {"circle", "c"}) {
    const Settings settings =
        read("far_field = { shape = \"" + shape + "\", radius = 16 }\n[boundary.box]\nspacing = 0.3\n");
    const double cells = mesh_options(settings, load(settings)).size.aim.value() / 0.3;
    const double edges = cells / std::cos(std::numbers::pi / 8);
    EXPECT_NEAR(cells * edges, 1, 1e-3) << shape;
  }
}

TEST_F(SizeSettings, TheDefaultOfMinPermitsCellsOfMax) {
  for (double max = 0.011; max < 9; max *= 1.37) {
    for (const char* const rest : {"", "gap = 2\n", "curvature = 10\n", "[boundary.box]\nspacing = 7\n"}) {
      for (const char* const far_field :
           {"", "far_field = 9\n", "far_field = { shape = \"c\", radius = 17 }\n"}) {
        const Settings settings = read(far_field + fmt::format("[spacing]\nmax = {}\n", max) + rest);
        const Geometry geometry = load(settings);
        const SizeOptions sizes = mesh_options(settings, geometry).size;
        const TreeGrid root = choose_root(geometry, sizes);
        EXPECT_FALSE(root.is_larger(root.finest_level(sizes.min), max)) << max << rest << far_field;
        EXPECT_TRUE(spacing_warnings(mesh_options(settings, geometry), geometry).empty()) << max << rest;
      }
    }
  }
}

TEST_F(SizeSettings, SizesAreSmallEnoughForLayersAndLines) {
  const auto min = [&](const std::string& text) {
    const Settings settings = read("far_field = 16\n[boundary.box]\nspacing = 0.125\n" + text);
    return mesh_options(settings, load(settings)).size.min;
  };
  EXPECT_NEAR(min("layers = { first = 0.01, growth = 1.5, count = 2 }\n"), 0.015, 1e-12) << "the last layer";
  EXPECT_EQ(min("layers = { first = 0.1, growth = 1.5, count = 2 }\n"), 0.0625);
  const double of_line =
      min("[[layer_line]]\npath = [[9, 9], [12, 9]]\nspacing = 0.1\nfirst = 0.001\ncount = 5\n");
  EXPECT_LT(of_line, 0.002) << "as the rows at its ends are high";
  EXPECT_GT(of_line, 0.001);
  EXPECT_EQ(min("[spacing]\nmin = 0.03\n[[layer_line]]\npath = [[9, 9], [12, 9]]\nspacing = 0.1\nfirst = "
                "0.001\ncount = 5\n"),
            0.03);
}

TEST_F(SizeSettings, WarnsOfSourcesThatDoNothing) {
  const Settings settings = read(
      "[spacing]\nmin = 0.5\nmax = 1\n[[source]]\nbox = [3, 9, 3, 9]\nspacing = 1\n[[source]]\ndisc = [9, 2, "
      "4.5]\nspacing = 1\n"
      "[[source]]\nline = [5, 0, 5, 4]\nspacing = 0.25\n");  // the root is the box, 0 to 4
  const Geometry geometry = load(settings);
  const Warnings warnings = spacing_warnings(mesh_options(settings, geometry), geometry);
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_NE(warnings[0].find(
                "case.toml:9: this [[source]] lies outside the root, which reaches from (0, 0) to (4, 4)"),
            std::string::npos);
  EXPECT_NE(warnings[1].find("case.toml:12: this [[source]] requests a spacing of 0.25 at (5, 2)"),
            std::string::npos);
  EXPECT_NE(warnings[2].find("case.toml:12: this [[source]] lies outside the root"), std::string::npos);
}

/// A regular polygon of radius 1, with points in the middle of its sides or without.
Chain polygon(int corners, bool has_middles = false) {
  std::vector<Point> points;
  const auto corner = [&](int k) {
    const double angle = k * 2 * std::numbers::pi / corners;
    return Point{std::cos(angle), std::sin(angle)};
  };
  for (int k = 0; k < corners; ++k) {
    points.push_back(corner(k));
    if (has_middles) points.push_back(0.5 * (corner(k) + corner(k + 1)));
  }
  return {"ring", false, points, "ring"};
}

Warnings warnings_of(const Chain& ring, Settings settings) {
  Warnings warnings;
  const Geometry geometry = assemble({ring}, settings.outline, warnings);
  return spacing_warnings(mesh_options(settings, geometry), geometry);
}

Settings with_spacing(double spacing) {
  Settings settings;
  settings.outline.rules = {{"ring", spacing, {}, {}, "here"}};
  return settings;
}

TEST(SpacingWarnings, TellOfAPolygonInFineCells) {
  EXPECT_TRUE(warnings_of(polygon(60), with_spacing(0.06)).empty());
  const Warnings fine = warnings_of(polygon(60), with_spacing(0.02));
  ASSERT_EQ(fine.size(), 1u);
  EXPECT_EQ(fine[0].find("boundary 'ring' turns by up to 6 degrees at 60 points"), 0u) << fine[0];
  EXPECT_NE(fine[0].find("smaller than 0.105"), std::string::npos) << fine[0];
}

TEST(SpacingWarnings, PointsOnStraightSidesDoNotHideAPolygon) {
  const Warnings fine = warnings_of(polygon(60, true), with_spacing(0.02));
  ASSERT_EQ(fine.size(), 1u);
  EXPECT_EQ(fine[0].find("boundary 'ring' turns by up to 6 degrees at 60 points"), 0u) << fine[0];
  EXPECT_NE(fine[0].find("smaller than 0.105"), std::string::npos) << fine[0];
}

TEST(SpacingWarnings, TellOfCurvatureThatMinLimits) {
  Settings settings = with_spacing(1);
  settings.max = 1;
  settings.min = 0.3;
  settings.mesh.size.curvature = 5;
  const Warnings limited = warnings_of(polygon(360), settings);  // 5 degrees of the circle are 0.0873 long
  ASSERT_EQ(limited.size(), 1u);
  EXPECT_EQ(limited[0].find("spacing.curvature = 5 requests smaller cells at 3"), 0u) << limited[0];
  EXPECT_NE(limited[0].find("of boundary 'ring', the smallest of 0.08726"), std::string::npos) << limited[0];
  EXPECT_NE(limited[0].find("), but spacing.min = 0.3 is larger"), std::string::npos) << limited[0];
  settings.min = 0.08;
  EXPECT_TRUE(warnings_of(polygon(360), settings).empty());
  settings.min = 0.02;  // one point of a polygon: no cell is small enough
  for (const std::string& warning : warnings_of(polygon(60), settings))
    EXPECT_EQ(warning.find("curvature"), std::string::npos) << warning;
}

TEST(SpacingWarnings, GiveThePlaceOfSizesThatMinLimits) {
  Settings settings = with_spacing(0.125);
  settings.outline.rules[0].corner_spacing = 0.0625;
  settings.max = 1;
  settings.min = 0.25;
  const Warnings limited = warnings_of(polygon(4), settings);
  ASSERT_EQ(limited.size(), 2u);
  EXPECT_EQ(limited[0],
            "boundary 'ring' requests a spacing of 0.125 at (1, 0), but spacing.min = 0.25 is larger; "
            "set a smaller spacing.min");
  EXPECT_EQ(limited[1],
            "boundary 'ring' requests a corner_spacing of 0.0625 at (1, 0), but spacing.min = 0.25 is "
            "larger; set a smaller spacing.min");
}

TEST(MeshOptions, WithoutAMinimumSizesGoDownToGaps) {
  Settings settings;
  settings.mesh.size.gap = 4;
  Warnings warnings;
  const Geometry geometry = assemble({{"sea", false, {{0, 0}, {8, 0}, {8, 8}, {0, 8}}, "a"},
                                      {"isle", false, {{0.1, 1}, {7, 1}, {7, 7}, {0.1, 7}}, "a"}},
                                     settings.outline, warnings);
  const double min = mesh_options(settings, geometry).size.min;
  EXPECT_LE(min, 0.1 / 4 / 2);
  EXPECT_GE(min, 0.1 / 4 / 8);
  EXPECT_TRUE(spacing_warnings(mesh_options(settings, geometry), geometry).empty());
  settings.min = 0.05;
  const Warnings limited = spacing_warnings(mesh_options(settings, geometry), geometry);
  ASSERT_EQ(limited.size(), 1u);
  EXPECT_EQ(limited[0].find("spacing.gap requests 4 cells across gaps"), 0u) << limited[0];
}

}  // namespace
}  // namespace quadloop
