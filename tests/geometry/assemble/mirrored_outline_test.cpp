// Outlines that are their own mirror image: rounding is mended, all else refused with its place.
#include "mesher/geometry/assemble/mirrored_outline.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"
#include "mesher/geometry/assemble/mirrored_curves.hpp"

namespace quadloop {
namespace {

/// Two triangles' outlines, each other's image in the x-axis, and a square round both.
std::vector<Chain> pair_in_box() {
  return {{"box", false, {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, "box"},
          {"upper", false, {{0, 1}, {0.3, 2.1}, {1, 1}}, "a.geom:3"},
          {"lower", false, {{0, -1}, {1, -1}, {0.3, -2.1}}, "a.geom:9"}};
}

Geometry outline(const AssembleOptions& options = {}) {
  Warnings warnings;
  return assemble(pair_in_box(), options, warnings);
}

std::string refusal(const auto& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(MirroredOutline, RoundingIsMendedAndTold) {
  std::vector<Chain> chains = pair_in_box();
  chains[2].points[2].y -= 4e-16;
  chains[0].points[0].x += 1e-15;
  chains.push_back({"on_axis", true, {{-3, 1e-16}, {-2, 0}}, "here"});
  Warnings warnings;
  fit_to_mirror(chains, MirrorAxis::x, warnings);
  EXPECT_EQ(chains[2].points[2], (Point{0.3, -2.1}));
  EXPECT_EQ(chains[0].points[0], (Point{-4, -4}));
  EXPECT_EQ(chains[3].points[0], (Point{-3, 0}));
  ASSERT_EQ(warnings.size(), 1);
  EXPECT_EQ(warnings[0].substr(0, 7), "moved 3");
}

TEST(MirroredOutline, NothingIsToldWhereAllIsExact) {
  std::vector<Chain> chains = pair_in_box();
  Warnings warnings;
  fit_to_mirror(chains, MirrorAxis::x, warnings);
  EXPECT_TRUE(warnings.empty());
  for (std::size_t i = 0; i < chains.size(); ++i) EXPECT_EQ(chains[i].points, pair_in_box()[i].points);
}

TEST(MirroredOutline, TheFirstPointWithoutAnImageIsNamed) {
  std::vector<Chain> chains = pair_in_box();
  chains[1].points[1].y += 1e-9;
  Warnings warnings;
  const std::string text = refusal([&] { fit_to_mirror(chains, MirrorAxis::x, warnings); });
  EXPECT_EQ(text.find("a.geom:3: boundary upper: the point (0.3, 2.100000001) has no mirror image at (0.3, "
                      "-2.100000001)"),
            0)
      << text;
  EXPECT_NE(text.find("1e-09 away"), std::string::npos) << text;
  EXPECT_EQ(text.find("translate"), std::string::npos) << text;
}

TEST(MirroredOutline, OneBesideTheAxisIsToBeMoved) {
  std::vector<Chain> chains = pair_in_box();
  for (Chain& chain : chains)
    for (Point& p : chain.points) p.y += 0.5;
  Warnings warnings;
  const std::string text = refusal([&] { fit_to_mirror(chains, MirrorAxis::x, warnings); });
  EXPECT_NE(text.find("its line of symmetry is at y = 0.5: move it onto the axis by geometry.translate"),
            std::string::npos)
      << text;
}

TEST(MirroredOutline, BoundariesMayBeEachOthersImages) {
  EXPECT_NO_THROW(require_mirror_images(outline(), MirrorAxis::x));
  AssembleOptions finer_above;
  finer_above.rules.push_back({"upper", 0.1, {}, {}, "case"});
  const std::string text = refusal([&] { require_mirror_images(outline(finer_above), MirrorAxis::x); });
  EXPECT_NE(text.find("with another spacing"), std::string::npos) << text;
}

TEST(MirroredOutline, EverySegmentHasItsImage) {
  const std::string text = refusal([&] { require_mirror_images(outline(), MirrorAxis::y); });
  EXPECT_NE(text.find("there is no mirror image of the part from (0, "), std::string::npos) << text;
}

/// A boundary whose image is one boundary here and another there.
TEST(MirroredOutline, AnImageIsOneBoundary) {
  Warnings warnings;
  std::vector<Chain> chains{{"right", true, {{0, -1}, {2, 0}, {0, 1}}, "r"},
                            {"above", true, {{0, 1}, {-1, 0.5}, {-1, 0}}, "a"},
                            {"below", true, {{-1, 0}, {-1, -0.5}, {0, -1}}, "b"}};
  EXPECT_NO_THROW(require_mirror_images(assemble(chains, {}, warnings), MirrorAxis::x));
  chains[1].points = {{0, 1}, {-1, 0.5}, {-1, 0}, {-1, -0.5}};
  chains[2].points = {{-1, -0.5}, {0, -1}};
  const std::string text =
      refusal([&] { require_mirror_images(assemble(chains, {}, warnings), MirrorAxis::x); });
  EXPECT_NE(text.find("belongs to two boundaries"), std::string::npos) << text;
}

/// A box round a wedge on the axis, whose blunt end the axis cuts in the middle, and round a pair beside it.
std::vector<Chain> wedge_in_box() {
  std::vector<Chain> chains = pair_in_box();
  chains.push_back({"wedge", false, {{-1, 0}, {3, 0.5}, {3, -0.5}}, "w"});
  return chains;
}

TEST(MirroredOutline, ItsHalfHasABoundaryAlongTheAxis) {
  Warnings warnings;
  for (const bool turned : {false, true}) {
    std::vector<Chain> chains = wedge_in_box();
    for (Chain& chain : chains)
      for (Point& p : chain.points)
        p = turned ? Point{p.y, -p.x} : p;  // the upper half becomes the right one
    const MirrorAxis axis = turned ? MirrorAxis::y : MirrorAxis::x;
    const Geometry half = assemble(half_outline(assemble(chains, {}, warnings), axis, "cut"), {}, warnings);
    EXPECT_EQ(half.loop_count(), 2) << "the box with half the wedge, the upper one of the pair";
    double cut = 0;
    for (std::int32_t s = 0; s < half.size(); ++s) {
      const Point from = half.point(s), to = half.point(half.next(s));
      EXPECT_GE(side_of(axis, from), 0);
      const bool along = side_of(axis, from) == 0 && side_of(axis, to) == 0;
      EXPECT_EQ(half.boundary(half.boundary_of(s)).name == "cut", along);
      if (along) cut += turned ? from.y - to.y : to.x - from.x;
    }
    EXPECT_EQ(cut, 4) << "3 before the wedge, 1 behind it; the domain to its left";
    for (const Boundary& boundary : half.boundaries()) EXPECT_NE(boundary.name, "lower");
  }
}

/// An airfoil of curves whose nose crosses the x-axis within a segment, in a box.
std::vector<Chain> curved_airfoil() {
  std::vector<Chain> chains{{"box", false, {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}, "box"},
                            {"airfoil",
                             false,
                             {{1, 0},
                              {0.5, -0.1},
                              {0.1, -0.07},
                              {0.03, -0.04},
                              {0.005, -0.015},
                              {0.005, 0.015},
                              {0.03, 0.04},
                              {0.1, 0.07},
                              {0.5, 0.1}},
                             "a.dat"}};
  join_by_splines(chains[1], 30);
  return chains;
}

TEST(MirroredCurves, CurvesBecomeExactImages) {
  std::vector<Chain> chains = curved_airfoil();
  chains[1].curves[1].inner[0].y -= 1e-12;
  Warnings warnings;
  fit_to_mirror(chains, MirrorAxis::x, warnings);
  const std::vector<Curve>& curves = chains[1].curves;
  ASSERT_EQ(curves.size(), 9U);
  for (std::size_t s = 0; s < 9; ++s) {
    Curve image = reversed(curves[8 - s]);
    for (Point& p : image.inner) p = image_of(MirrorAxis::x, p);
    EXPECT_EQ(image, curves[s]) << s;
  }
}

TEST(MirroredCurves, TheHalfFollowsTheCurveAcrossTheAxis) {
  std::vector<Chain> chains = curved_airfoil();
  Warnings warnings;
  fit_to_mirror(chains, MirrorAxis::x, warnings);
  const Geometry whole = assemble(chains, {}, warnings);
  require_mirror_images(whole, MirrorAxis::x);
  AssembleOptions options;
  const Geometry half = assemble(half_outline(whole, MirrorAxis::x, "axis"), options, warnings);
  EXPECT_TRUE(half.has_curves());
  double nose = 1;
  for (std::int32_t v = 0; v < half.size(); ++v) {
    if (half.boundary(half.boundary_of(v)).name == "airfoil") nose = std::min(nose, half.point(v).x);
    EXPECT_GE(half.point(v).y, 0);
  }
  EXPECT_LT(nose, 0.004) << "the curve bulges beyond its ends";
}

TEST(MirroredCurves, ACurveWithoutAnImageIsRefused) {
  std::vector<Chain> chains = curved_airfoil();
  chains[1].curves[7].inner[0].y += 1e-3;
  const std::string text = refusal([&] { fit_curves_to_mirror(chains, MirrorAxis::x, 1e-9); });
  EXPECT_NE(text.find("a.dat: boundary airfoil: the curve from (0.5, -0.1) to (0.1, -0.07)"),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace quadloop
