// Tables [[shape]]: what they describe, beside files and a far field, and their refusals.
#include "quadloop/case/shape_settings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesher/geometry/assemble/shapes.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop {
namespace {

class ShapeSettings : public ::testing::Test {
 protected:
  Settings read(const std::string& text, const std::vector<std::string>& assignments = {}) {
    return read_settings(folder_.write("case.toml", text), assignments);
  }
  Geometry load(const std::string& text) {
    warnings_.clear();
    return load_geometry(read(text), warnings_);
  }
  Chain only(const std::string& text) {
    const Settings settings = read("[[shape]]\n" + text);
    EXPECT_EQ(settings.shapes.size(), 1U);
    return settings.shapes.front().chain;
  }
  std::string refused(const std::string& text) {
    return test::refusal(folder_, [&] { load(text); });
  }
  void expect_refused(const std::string& text, const std::string& piece) {
    const std::string said = refused(text);
    EXPECT_NE(said.find(piece), std::string::npos) << text << "\n" << said;
  }

  test::InputFolder folder_;
  Warnings warnings_;
};

const std::string airfoil = "[[shape]]\nname = \"wing\"\nkind = \"naca\"\ncode = \"2412\"\n";
const std::string far = "[geometry]\nfar_field = 10\n";

TEST_F(ShapeSettings, AnAirfoilIsThatOfItsCode) {
  const Chain wing = only("name = \"wing\"\ncode = \"2412\"\n");
  NacaAirfoil naca;
  naca.code = "2412";
  EXPECT_EQ(wing.points, naca_chain("wing", naca, "").points);
  EXPECT_TRUE(wing.source.ends_with("/case.toml:1")) << "for messages";
  EXPECT_EQ(only("name = \"wing\"\ncode = \"naca2412\"\n").points, wing.points);
  naca.sharp = false;
  EXPECT_EQ(only("name = \"wing\"\ncode = \"2412\"\nsharp = false\n").points,
            naca_chain("wing", naca, "").points);
  naca.flap_degrees = 5;
  naca.hinge = {0.8, 0.01};
  EXPECT_EQ(only("name = \"w\"\ncode = \"2412\"\nsharp = false\nflap = 5\nhinge = [0.8, 0.01]\n").points,
            naca_chain("wing", naca, "").points);
}

TEST_F(ShapeSettings, CurvesThatMeetFormAnOutline) {
  const std::string
      wall = "[[shape]]\nname = \"wall\"\nkind = \"curve\"\npoints = [[2, 0], [2, 1], [0, 1], [0, 0]]\n",
      floor = "[[shape]]\nname = \"floor\"\nkind = \"curve\"\npoints = [[2, 0], [1, 0.1], [0, 0]]\n";
  const Geometry straight = load(wall + floor), bent = load(wall + floor + "spline = true\n");
  EXPECT_EQ(straight.size(), 5);
  EXPECT_EQ(straight.boundaries().size(), 2U);
  EXPECT_FALSE(straight.has_curves());
  EXPECT_TRUE(bent.has_curves());
  expect_refused(wall, "not watertight");
  expect_refused("[[shape]]\nname = \"rod\"\nkind = \"circle\"\nradius = 1\nspline = true\n", "spline");
}

TEST_F(ShapeSettings, AShapeIsScaledThenTurnedThenMoved) {
  const Chain chain = only(
      "name = \"a\"\nkind = \"polygon\"\npoints = [[0, 0], [1, 0], [0, 1]]\nscale = 2\nrotate = 90\n"
      "rotate_about = [2, 0]\ntranslate = [10, 0]\n");
  EXPECT_EQ(chain.points, (std::vector<Point>{{12, -2}, {12, 0}, {10, -2}}));
}

TEST_F(ShapeSettings, ACircleAndARectangleBoundADomainWithoutAFile) {
  const Geometry geometry = load(
      "[[shape]]\nname = \"channel\"\nkind = \"rectangle\"\nbox = [-2, 6, -1, 3]\n[[shape]]\nname = "
      "\"rod\"\nkind = \"circle\"\nradius = 0.5\n[boundary.rod]\nbc = \"wall\"\n");
  EXPECT_TRUE(warnings_.empty()) << "the direction of shapes is open";
  ASSERT_EQ(geometry.loop_count(), 2);
  EXPECT_EQ(geometry.boundary(geometry.boundary_of(0)).name, "channel");
  EXPECT_EQ(geometry.point(0), (Point{-2, -1}));
  EXPECT_EQ(geometry.boundaries()[1].name, "rod");
  EXPECT_EQ(geometry.boundaries()[1].condition, BoundaryCondition::wall);
  for (std::int32_t v = geometry.loop_start(1); v < geometry.size(); ++v)
    EXPECT_NEAR(length(geometry.point(v)), 0.5, 1e-15);
}

TEST_F(ShapeSettings, ShapesStandBesideFilesAndAFarField) {
  folder_.write("box.geom", "1\nbox\n4\n2 2\n2 3\n3 3\n3 2\n");
  const Geometry geometry = load("[geometry]\nfile = \"box.geom\"\nscale = 2\nfar_field = 20\n" + airfoil);
  ASSERT_EQ(geometry.loop_count(), 3);
  EXPECT_EQ(geometry.boundaries()[0].name, "box");
  EXPECT_EQ(geometry.boundaries()[1].name, "wing");
  EXPECT_EQ(geometry.boundaries()[2].name, "farfield");
  EXPECT_EQ(geometry.point(0).x, 4) << "keys of [geometry] place files";
  EXPECT_EQ(geometry.point(geometry.loop_start(1)), (Point{1, 0})) << "not shapes";
}

TEST_F(ShapeSettings, AnAirfoilIsABody) {
  expect_refused(airfoil,
                 "case.toml:1: boundary 'wing' has no outer boundary around it; set geometry.far_field");
  EXPECT_EQ(load(far + airfoil).loop_count(), 2);
  EXPECT_EQ(load("[geometry]\ninside = true\n" + airfoil).loop_count(), 1);
}

TEST_F(ShapeSettings, ShapesOfOneNameAreOneBoundary) {
  const Geometry geometry =
      load(far +
           "[[shape]]\nname = \"rods\"\nkind = \"circle\"\nradius = 1\n[[shape]]\nname = "
           "\"rods\"\nkind = \"circle\"\ncentre = [3, 0]\nradius = 1\n");
  EXPECT_EQ(geometry.boundaries().size(), 2U);
  EXPECT_EQ(geometry.loop_count(), 3);
}

TEST_F(ShapeSettings, AValueCanBeSetOnTheCommandLine) {
  const std::string text = far + airfoil;
  EXPECT_NE(read(text, {"shape.0.flap=10"}).shapes[0].chain.points, read(text).shapes[0].chain.points);
  EXPECT_NE(read(text, {"shape.0.code=0012"}).shapes[0].chain.points, read(text).shapes[0].chain.points);
}

TEST_F(ShapeSettings, WithoutAnOutlineACaseIsRefused) {
  expect_refused("title = \"x\"\n",
                 "needs an outline; name one, as in [geometry] file = \"outline.geom\", or add a [[shape]]");
  expect_refused(far, "needs an outline");
}

TEST_F(ShapeSettings, WrongKeysAreNamed) {
  const auto shape = [](const std::string& keys) { return far + "[[shape]]\n" + keys; };
  expect_refused(shape("code = \"2412\"\n"),
                 "case.toml:3: 'shape.0.name' is missing: the name of the boundary");
  expect_refused(shape("name = \"a b\"\ncode = \"2412\"\n"),
                 "case.toml:4: 'shape.0.name' is no name for a boundary");
  expect_refused(shape("name = \"a\"\n"), "case.toml:3: 'shape.0.code' is missing: as in code = \"2412\"");
  expect_refused(
      shape("name = \"a\"\ncode = \"26012\"\n"),
      "case.toml:5: 'shape.0.code' is wrong: '26012' is not the code of a NACA section; give four digits");
  expect_refused(shape("name = \"a\"\ncode = 2412\n"),
                 "case.toml:5: 'shape.0.code' must be a text in quotes");
  expect_refused(shape("name = \"a\"\nkind = \"square\"\n"),
                 "case.toml:5: 'shape.0.kind' is 'square', but must be one of");
  expect_refused(shape("name = \"a\"\nkind = \"circle\"\n"), "'shape.0.radius' is missing");
  expect_refused(shape("name = \"a\"\nkind = \"circle\"\nradius = 0\n"),
                 "case.toml:6: 'shape.0.radius' is 0");
  expect_refused(shape("name = \"a\"\nkind = \"circle\"\nradius = 1\nbox = [0, 1, 0, 1]\n"),
                 "case.toml:7: 'shape.0.box' needs kind = \"rectangle\", but kind = \"circle\"");
  expect_refused(shape("name = \"a\"\nkind = \"rectangle\"\nbox = [0, 0, 0, 1]\n"),
                 "'shape.0.box' is [0, 0, 0, 1], but must be [x0, x1, y0, y1] with x0 < x1");
  expect_refused(shape("name = \"a\"\nkind = \"polygon\"\n"), "'shape.0.points' is missing");
  expect_refused(shape("name = \"a\"\nkind = \"polygon\"\npoints = [[0, 0], [1, 0]]\n"), "case.toml:3: ");
  expect_refused(shape("name = \"a\"\ncode = \"2412\"\nchord = 2\n"),
                 "case.toml:6: unknown key 'shape.0.chord'");
  expect_refused(shape("name = \"a\"\ncode = \"2412\"\nhinge = 0.7\n"), "'shape.0.hinge' needs flap");
  expect_refused(shape("name = \"a\"\ncode = \"2412\"\nflap = 100\n"), "case.toml:6: 'shape.0.flap' is 100");
  expect_refused(shape("name = \"a\"\ncode = \"2412\"\nflap = 10\nhinge = [0.7, 0.5]\n"),
                 "case.toml:6: 'shape.0.flap' is wrong: the hinge at (0.7, 0.5) is not inside '2412'");
  expect_refused(shape("name = \"a\"\ncode = \"2412\"\nflap = 10\nhinge = [0.7, 0.5, 1]\n"),
                 "'shape.0.hinge' must be a place on the chord, or [x, y]");
  expect_refused(shape("name = \"farfield\"\ncode = \"2412\"\n"),
                 "already has a boundary 'farfield' (case.toml:3)");
  expect_refused("[geometry]\nfar_field = 10\nrotate = -9\n" + airfoil,
                 "case.toml:3: 'geometry.rotate' needs file; a [[shape]] is placed by its own keys");
}

}  // namespace
}  // namespace quadloop
