// NACA sections against published ordinates and the conditions that define them.
#include "mesher/geometry/assemble/naca_section.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/base/error.hpp"

namespace quadloop {
namespace {

double upper(const std::string& code, double x, bool sharp = false) {
  return NacaSection(code, sharp).point_at(x, 1).y;
}

TEST(NacaSection, FourDigitsHavePublishedOrdinates) {
  // NACA report 460, table of the basic thickness of the 0012 section, in per cent of the chord.
  EXPECT_NEAR(upper("0012", 0.30), 0.06002, 1e-5);
  EXPECT_NEAR(upper("0012", 0.0125), 0.01894, 1e-5);
  EXPECT_NEAR(upper("0012", 0.60), 0.04563, 1e-5);
  EXPECT_NEAR(upper("0012", 1.00), 0.00126, 1e-5);
  EXPECT_NEAR(upper("0012", 1.00, true), 0, 1e-15);
}

TEST(NacaSection, CamberIsLargestAtItsPlace) {
  const NacaSection section("2412", true);
  const auto camber = [&](double x) { return 0.5 * (section.point_at(x, 1).y + section.point_at(x, -1).y); };
  EXPECT_NEAR(camber(0.4), 0.02, 1e-15);
  EXPECT_LT(camber(0.39), 0.02);
  EXPECT_LT(camber(0.41), 0.02);
  EXPECT_NEAR(camber(1), 0, 1e-15);
}

TEST(NacaSection, FiveDigitsHaveTheirCamberLine) {
  // Abbott and von Doenhoff: the 230 camber line has its largest height 0.01837 near 0.15 of the chord.
  const NacaSection section("23012", true);
  double highest = 0, at = 0;
  for (int i = 1; i < 1000; ++i) {
    const double x = i / 1000.0, height = 0.5 * (section.point_at(x, 1).y + section.point_at(x, -1).y);
    if (height > highest) highest = height, at = x;
  }
  EXPECT_NEAR(highest, 0.01837, 2e-4);
  EXPECT_NEAR(at, 0.15, 0.02);
  EXPECT_LT(NacaSection("23112", true).point_at(0.9, 1).y, section.point_at(0.9, 1).y) << "reflexed";
}

TEST(NacaSection, ModifiedSectionsAreThickestAtTheirPlaceWithOneCurvature) {
  for (const char* code : {"0012-34", "0012-63", "0012-65", "0012-94"}) {
    const NacaSection section(code, true);
    const double t = (code[6] - '0') / 10.0, h = 1e-4;
    const auto y = [&](double x) { return section.point_at(x, 1).y; };
    EXPECT_NEAR(y(t), 0.06, 1e-15) << code;
    EXPECT_LT(y(t - 0.01), 0.06);
    EXPECT_LT(y(t + 0.01), 0.06);
    const double before = (y(t) - 2 * y(t - h) + y(t - 2 * h)) / (h * h),
                 behind = (y(t + 2 * h) - 2 * y(t + h) + y(t)) / (h * h);
    EXPECT_NEAR(before, behind, 2e-2 * std::abs(behind)) << code;
    EXPECT_NEAR(y(1), 0, 1e-15);
  }
}

TEST(NacaSection, SurfacesAreMirrorImagesWithoutCamber) {
  const NacaSection section("naca0012", true);
  const std::vector<Point> upper = section.surface(1, 0, 1, 41), lower = section.surface(-1, 0, 1, 41);
  ASSERT_EQ(upper.size(), 41U);
  EXPECT_EQ(upper.front(), (Point{0, 0}));
  EXPECT_EQ(upper.back(), (Point{1, 0}));
  for (std::size_t i = 0; i < upper.size(); ++i) EXPECT_EQ(lower[i], (Point{upper[i].x, -upper[i].y}));
  EXPECT_EQ(upper[20].x, 0.5) << "cosine spacing";
  EXPECT_EQ(section.surface(1, 0, 1, 201)[100].x, 0.5) << "a line of many grids";
}

TEST(NacaSection, APartOfASurfaceHasBothItsEnds) {
  const NacaSection section("2412", false);
  const std::vector<Point> part = section.surface(-1, 0.4, 0.7, 41);
  EXPECT_EQ(part.front(), section.point_at(0.4, -1));
  EXPECT_EQ(part.back(), section.point_at(0.7, -1));
  for (std::size_t i = 1; i < part.size(); ++i) EXPECT_GT(length(part[i] - part[i - 1]), 0.015);
}

TEST(NacaSection, WrongCodesAreRefused) {
  for (const char* code : {"", "12", "abcd", "2012", "0412", "0000", "26012", "20012", "21112", "0012-",
                           "0012-61", "0012-6", "23012-63", "naca", "NACA0012", "0012 "})
    EXPECT_THROW(NacaSection(code, true), InputError) << code;
}

}  // namespace
}  // namespace quadloop
