#include "io/step/step_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <numbers>
#include <utility>

#include "io/step/space_curve.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "tests/io/input/temporary_file.hpp"
#include "tests/io/step/step_text.hpp"

namespace quadloop::io {
namespace {

constexpr double pi = std::numbers::pi;

class StepReader : public ::testing::Test {
 protected:
  std::vector<Chain> read(const std::string& text) {
    warnings_.clear();
    return read_step(folder_.write("part.stp", text), choice_, warnings_, unit_);
  }
  /// The chains of a file with these items.
  std::vector<Chain> read_items(const std::vector<std::string>& items) { return read(step_.file(items)); }
  std::string refusal(const std::vector<std::string>& items) {
    return test::refusal(folder_, [&] { read_items(items); });
  }
  std::string trimmed(const std::string& basis, const std::string& from, const std::string& to, bool same,
                      const std::string& master = "PARAMETER") {
    return step_.add(
        fmt::format("TRIMMED_CURVE('',{},({}),({}),{},.{}.)", basis, from, to, same ? ".T." : ".F.", master));
  }

  test::InputFolder folder_;
  test::StepText step_;
  DrawingChoice choice_;
  std::vector<std::string> warnings_;
  FileUnit unit_;
};

std::vector<CurvedSegment> segments_of(const Chain& chain) {
  std::vector<CurvedSegment> segments;
  const std::size_t n = chain.points.size(), count = chain.open ? n - 1 : n;
  for (std::size_t i = 0; i < count; ++i)
    segments.push_back(
        {chain.points[i], chain.curves.empty() ? Curve() : chain.curves[i], chain.points[(i + 1) % n]});
  return segments;
}

std::vector<Point> sampled(const Chain& chain) {
  std::vector<Point> points;
  for (const CurvedSegment& segment : segments_of(chain)) {
    for (int i = 0; i <= 10; ++i) points.push_back(point_at(segment, i / 10.0));
  }
  return points;
}

double length_of(const Chain& chain) {
  double sum = 0;
  for (const CurvedSegment& segment : segments_of(chain)) {
    Point last = segment.from;
    for (int i = 1; i <= 200; ++i) {
      const Point p = point_at(segment, i / 200.0);
      sum += length(p - last);
      last = p;
    }
  }
  return sum;
}

void expect_on_circle(const Chain& chain, Point centre, double radius) {
  for (const Point p : sampled(chain)) EXPECT_NEAR(length(p - centre), radius, 1e-12 * radius);
}

void expect_ends(const Chain& chain, Point a, Point b) {
  ASSERT_TRUE(chain.open);
  const bool forwards = length(chain.points.front() - a) < length(chain.points.front() - b);
  EXPECT_LT(length(chain.points.front() - (forwards ? a : b)), 1e-12);
  EXPECT_LT(length(chain.points.back() - (forwards ? b : a)), 1e-12);
}

bool passes(const Chain& chain, Point p) {
  return std::ranges::any_of(sampled(chain), [&](Point q) { return length(q - p) < 0.06; });
}

/// A plate of 4 x 2 with a round hole, as OpenCASCADE writes it: curves on surfaces, unnamed.
std::string plate(test::StepText& step, const std::string& face_name = "",
                  const std::string& edge_name = "") {
  const std::vector<Point> corners{{0, 0}, {4, 0}, {4, 2}, {0, 2}};
  std::vector<std::string> vertices, edges;
  for (const Point p : corners) vertices.push_back(step.vertex(p.x, p.y));
  const std::string plane = step.add("PLANE(''," + step.placement(0, 0) + ")");
  for (int i = 0; i < 4; ++i) {
    const Point from = corners[i], d = corners[(i + 1) % 4] - from;
    const std::string line = step.line(step.point(from.x, from.y), d.x, d.y);
    const std::string flat =
        step.add("PCURVE(''," + plane + "," + step.add("DEFINITIONAL_REPRESENTATION('',(),#1)") + ")");
    const std::string curve = step.add("SURFACE_CURVE(''," + line + ",(" + flat + "),.PCURVE_S1.)");
    // The second edge is written from its end to its beginning.
    edges.push_back(i == 1 ? step.edge(vertices[2], vertices[1], curve, false, edge_name)
                           : step.edge(vertices[i], vertices[(i + 1) % 4], curve));
  }
  const std::string seam = step.vertex(1.5, 1);
  const std::string circle = step.add("CIRCLE(''," + step.placement(1, 1) + ",0.5)");
  const std::string outer = step.add("FACE_OUTER_BOUND(''," + step.loop(edges, "+-++") + ",.T.)");
  const std::string inner =
      step.add("FACE_BOUND(''," + step.loop({step.edge(seam, seam, circle)}, "-") + ",.T.)");
  return step.add(fmt::format("ADVANCED_FACE('{}',({},{}),{},.T.)", face_name, outer, inner, plane));
}

TEST_F(StepReader, ReadsTrimmedLinesByParameterAndByPoint) {
  const std::string line = step_.line(step_.point(1, 1), 3, 4, 0, 2);
  const auto chains =
      read_items({step_.set({trimmed(line, "PARAMETER_VALUE(0.5)", "PARAMETER_VALUE(2.)", true),
                             trimmed(line, step_.point(4, 5), step_.point(1, 1), false, "CARTESIAN")})});
  ASSERT_EQ(chains.size(), 2u);
  expect_ends(chains[0], {1.6, 1.8}, {3.4, 4.2});
  expect_ends(chains[1], {4, 5}, {1, 1});
  EXPECT_TRUE(chains[0].curves.empty());
  EXPECT_FALSE(chains[0].directed);
  EXPECT_EQ(unit_.plane, "");
}

TEST_F(StepReader, ReadsTrimmedCirclesInBothSenses) {
  const std::string circle = step_.add("CIRCLE(''," + step_.placement(1, 2) + ",2.)");
  const std::string east = step_.point(3, 2), north = step_.point(1, 4);
  const auto chains = read_items({step_.set(
      {trimmed(circle, east, north, true, "CARTESIAN"), trimmed(circle, east, north, false, "CARTESIAN"),
       trimmed(circle, "PARAMETER_VALUE(0.)", fmt::format("PARAMETER_VALUE({})", pi / 2), true),
       trimmed(circle, fmt::format("PARAMETER_VALUE({})", pi / 2), "PARAMETER_VALUE(0.)", true),
       trimmed(circle, east + ",PARAMETER_VALUE(0.)", fmt::format("PARAMETER_VALUE({}),{}", pi / 2, north),
               true)})});
  ASSERT_EQ(chains.size(), 5u);
  for (const Chain& chain : chains) {
    expect_on_circle(chain, {1, 2}, 2);
    expect_ends(chain, {3, 2}, {1, 4});
  }
  for (const int quarter : {0, 2, 4}) EXPECT_NEAR(length_of(chains[quarter]), pi, 1e-4);
  for (const int rest : {1, 3}) EXPECT_NEAR(length_of(chains[rest]), 3 * pi, 1e-4);
}

TEST_F(StepReader, ReadsEdgesOnReversedTrimmedCurves) {
  const std::string circle = step_.add("CIRCLE(''," + step_.placement(1, 2) + ",2.)");
  const std::string east = step_.point(3, 2), north = step_.point(1, 4);
  const std::string rest = trimmed(circle, east, north, false, "CARTESIAN");  // clockwise
  const std::string a = step_.vertex(3, 2), b = step_.vertex(1, 4);
  const auto chains = read_items({step_.add("CONNECTED_EDGE_SET('',(" + step_.edge(a, b, rest) + "," +
                                            step_.edge(a, b, rest, false) + "))")});
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_NEAR(length_of(chains[0]), 3 * pi, 1e-4);
  EXPECT_NEAR(length_of(chains[1]), pi, 1e-4) << "against the direction of the trimmed curve";
}

TEST_F(StepReader, TakesParametersOfCirclesInTheUnitOfAngle) {
  step_.angle_unit = "CONVERSION_BASED_UNIT('DEGREE'," +
                     step_.add("PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(1.745329252E-2)," +
                               step_.add("(NAMED_UNIT(*) PLANE_ANGLE_UNIT() SI_UNIT($,.RADIAN.))") + ")") +
                     ")";
  const std::string circle = step_.add("CIRCLE(''," + step_.placement(0, 0) + ",1.)");
  const auto chains =
      read_items({step_.set({trimmed(circle, "PARAMETER_VALUE(30.)", "PARAMETER_VALUE(150.)", true)})});
  expect_ends(chains[0], {std::sqrt(3) / 2, 0.5}, {-std::sqrt(3) / 2, 0.5});
}

TEST_F(StepReader, ReadsFullCirclesAsFourArcs) {
  const std::string circle = step_.add("CIRCLE('hole'," + step_.placement(5, 0) + ",0.5)");
  const std::string seam = step_.vertex(5, -0.5);
  for (const std::string& item :
       {circle, trimmed(circle, "PARAMETER_VALUE(0.)", fmt::format("PARAMETER_VALUE({})", 2 * pi), true),
        trimmed(circle, step_.point(5.5, 0), step_.point(5.5, 0), false, "CARTESIAN")}) {
    test::StepText only = step_;
    const auto chains = read(only.file({only.set({item})}));
    ASSERT_EQ(chains.size(), 1u);
    EXPECT_FALSE(chains[0].open);
    EXPECT_EQ(chains[0].points.size(), 4u);
    EXPECT_EQ(chains[0].curves.size(), 4u);
    expect_on_circle(chains[0], {5, 0}, 0.5);
    EXPECT_NEAR(length_of(chains[0]), pi, 1e-4);
  }
  const auto chains =
      read_items({step_.add("CONNECTED_EDGE_SET('',(" + step_.edge(seam, seam, circle) + "))")});
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_FALSE(chains[0].open);
  EXPECT_EQ(chains[0].name, "hole");
  EXPECT_EQ(chains[0].points[0], (Point{5, -0.5})) << "the loop begins at the vertex of the edge";
  expect_on_circle(chains[0], {5, 0}, 0.5);
}

TEST_F(StepReader, ReadsEllipsesAlsoTurnedAboutTheirAxis) {
  const double c = std::cos(0.4), s = std::sin(0.4);
  const std::string place =
      step_.placement(step_.point(1, -1), step_.direction(0, 0, -1), step_.direction(c, s));
  const std::string ellipse = step_.add("ELLIPSE(''," + place + ",3.,1.)");
  const auto chains = read_items({step_.set(
      {ellipse, trimmed(ellipse, "PARAMETER_VALUE(0.)", fmt::format("PARAMETER_VALUE({})", pi / 2), true)})});
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_FALSE(chains[0].open);
  for (const Chain& chain : chains) {
    for (const Point p : sampled(chain)) {
      const Point d = p - Point{1, -1};
      EXPECT_NEAR(std::hypot((d.x * c + d.y * s) / 3, d.x * s - d.y * c), 1, 1e-12);
    }
  }
  // About the axis -z the second half axis is z x major.
  expect_ends(chains[1], {1 + 3 * c, -1 + 3 * s}, {1 + s, -1 - c});
}

TEST_F(StepReader, ReadsPolylines) {
  const std::string a = step_.point(0, 0), b = step_.point(4, 0), c = step_.point(4, 3),
                    again = step_.point(4, 0);
  const auto chains =
      read_items({step_.set({step_.add("POLYLINE('tri'," + test::StepText::list({a, b, again, c, a}) + ")"),
                             step_.add("POLYLINE(''," + test::StepText::list({a, b, c}) + ")")})});
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_EQ(chains[0].points, (std::vector<Point>{{0, 0}, {4, 0}, {4, 3}}));
  EXPECT_FALSE(chains[0].open);
  EXPECT_EQ(chains[0].name, "tri");
  EXPECT_TRUE(chains[1].open);
  EXPECT_EQ(chains[1].name, "part") << "the name of the file";
}

/// A B-spline in a STEP file, and for comparison.
struct Spline {
  std::string poles;
  SpaceSpline exact;
};

Spline sample_spline(test::StepText& step) {
  Spline spline;
  spline.exact = {
      3,
      {0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 3},
      {{{0, 0, 0}}, {{1, 2, 0}}, {{3, 3, 0}}, {{4, 0, 0}}, {{6, -1, 0}}, {{7, 2, 0}}, {{9, 2, 0}}},
      {}};
  std::vector<std::string> poles;
  for (const SpacePoint& p : spline.exact.poles) poles.push_back(step.point(p.at[0], p.at[1]));
  spline.poles = test::StepText::list(poles);
  return spline;
}

void expect_on_spline(const Chain& chain, const SpaceSpline& exact) {
  for (const Point p : sampled(chain)) {
    const SpacePoint q = exact.point_at(nearest_parameter(exact, {{p.x, p.y, 0}}));
    EXPECT_LT(length(p - Point{q.at[0], q.at[1]}), 9e-12);
  }
}

TEST_F(StepReader, ReadsBSplinesWithKnots) {
  const Spline spline = sample_spline(step_);
  const auto chains =
      read_items({step_.set({step_.add("B_SPLINE_CURVE_WITH_KNOTS('s',3," + spline.poles +
                                       ",.UNSPECIFIED.,.F.,.U.,(4,1,2,4),(0.,1.,2.,3.),.UNSPECIFIED.)")})});
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].points.size(), 4u) << "a point at each knot";
  expect_ends(chains[0], {0, 0}, {9, 2});
  expect_on_spline(chains[0], spline.exact);
  EXPECT_NE(chains[0].source.find("B_SPLINE_CURVE_WITH_KNOTS #8"), std::string::npos) << chains[0].source;
}

TEST_F(StepReader, ReadsRationalBSplinesAsComplexInstances) {
  Spline spline = sample_spline(step_);
  spline.exact.weights = {1, 2, 0.5, 1, 3, 1, 1};
  const auto chains = read_items({step_.set({step_.add(
      "(BOUNDED_CURVE() B_SPLINE_CURVE(3," + spline.poles +
      ",.UNSPECIFIED.,.F.,.F.) B_SPLINE_CURVE_WITH_KNOTS((4,1,2,4),(0.,1.,2.,3.),.UNSPECIFIED.) CURVE() "
      "GEOMETRIC_REPRESENTATION_ITEM() RATIONAL_B_SPLINE_CURVE((1.,2.,0.5,1.,3.,1.,1.)) "
      "REPRESENTATION_ITEM('nurbs'))")})});
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].name, "nurbs");
  expect_on_spline(chains[0], spline.exact);
}

TEST_F(StepReader, ReadsSplinesWithoutKnots) {
  const Spline spline = sample_spline(step_);
  const std::string rest = "('',3," + spline.poles + ",.UNSPECIFIED.,.F.,.F.)";
  SpaceSpline bezier = spline.exact, quasi = spline.exact, uniform = spline.exact;
  bezier.knots = {0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2};
  quasi.knots = {0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4};
  uniform.knots = {-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7};
  const auto chains =
      read_items({step_.set({step_.add("BEZIER_CURVE" + rest), step_.add("QUASI_UNIFORM_CURVE" + rest),
                             step_.add("UNIFORM_CURVE" + rest)})});
  ASSERT_EQ(chains.size(), 3u);
  EXPECT_EQ(chains[0].points.size(), 3u);
  expect_on_spline(chains[0], bezier);
  EXPECT_EQ(chains[1].points.size(), 5u);
  expect_on_spline(chains[1], quasi);
  expect_on_spline(chains[2], uniform);
  const SpacePoint start = uniform.point_at(0);
  EXPECT_LT(length(chains[2].points[0] - Point{start.at[0], start.at[1]}), 1e-12);
}

TEST_F(StepReader, CutsBSplines) {
  const Spline spline = sample_spline(step_);
  const std::string curve = step_.add("B_SPLINE_CURVE_WITH_KNOTS('',3," + spline.poles +
                                      ",.UNSPECIFIED.,.F.,.F.,(4,1,2,4),(0.,1.,2.,3.),.UNSPECIFIED.)");
  const SpacePoint a = spline.exact.point_at(0.25), b = spline.exact.point_at(2.75);
  const Point from{a.at[0], a.at[1]}, to{b.at[0], b.at[1]};
  const std::string first = step_.vertex(from.x, from.y), last = step_.vertex(to.x, to.y);
  const auto chains =
      read_items({step_.set({trimmed(curve, "PARAMETER_VALUE(0.25)", "PARAMETER_VALUE(2.75)", true),
                             trimmed(curve, "PARAMETER_VALUE(2.75)", "PARAMETER_VALUE(0.25)", false)}),
                  step_.add("CONNECTED_EDGE_SET('',(" + step_.edge(first, last, curve) + "," +
                            step_.edge(last, first, curve, false) + "))")});
  ASSERT_EQ(chains.size(), 4u);
  for (const Chain& chain : chains) {
    expect_ends(chain, from, to);
    expect_on_spline(chain, spline.exact);
    EXPECT_EQ(chain.points.size(), 4u);
  }
  EXPECT_EQ(chains[2].points.front(), from) << "the coordinates of the vertex";
}

TEST_F(StepReader, CutsClosedBSplinesAcrossTheirSeam) {
  const std::vector<Point> square{{1, 0}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}, {1, 0}};
  std::vector<std::string> poles;
  for (const Point p : square) poles.push_back(step_.point(p.x, p.y));
  const std::string curve = step_.add("B_SPLINE_CURVE_WITH_KNOTS('',2," + test::StepText::list(poles) +
                                      ",.UNSPECIFIED.,.T.,.F.,(3,1,1,1,3),(0.,1.,2.,3.,4.),.UNSPECIFIED.)");
  const std::string left = step_.vertex(-1, 0), top = step_.vertex(0, 1), seam = step_.vertex(1, 0);
  const auto count = [&](const std::string& edge) {
    test::StepText only = step_;
    return read(only.file({only.add("CONNECTED_EDGE_SET('',(" + edge + "))")}));
  };
  const auto whole = count(step_.edge(seam, seam, curve));
  ASSERT_EQ(whole.size(), 1u);
  EXPECT_FALSE(whole[0].open);
  for (const Point p : {Point{0, 1}, {-1, 0}, {0, -1}, {1, 0}}) EXPECT_TRUE(passes(whole[0], p));
  const std::string rounded = step_.vertex(1 + 1e-12, 0);
  EXPECT_FALSE(count(step_.edge(rounded, rounded, curve))[0].open) << "the vertex differs by rounding";
  const auto across = count(step_.edge(left, top, curve));  // through the lower side and the seam
  ASSERT_EQ(across.size(), 2u);
  expect_ends(across[0], {-1, 0}, {1, 0});
  expect_ends(across[1], {1, 0}, {0, 1});
  EXPECT_TRUE(passes(across[0], {0, -1}));
  const auto back = count(step_.edge(left, top, curve, false));
  ASSERT_EQ(back.size(), 1u);
  expect_ends(back[0], {-1, 0}, {0, 1});
  EXPECT_FALSE(passes(back[0], {0, -1}));
  const auto turn = count(step_.edge(left, left, curve));
  ASSERT_EQ(turn.size(), 2u) << "from the vertex to the seam, and on to the vertex";
}

TEST_F(StepReader, ReadsCompositeCurves) {
  const std::string a = step_.point(0, 0), b = step_.point(2, 0), c = step_.point(2, 2);
  const std::string circle = step_.add("CIRCLE(''," + step_.placement(2, 1) + ",1.)");
  const auto segment = [&](const std::string& curve, const char* same) {
    return step_.add(fmt::format("COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,{},{})", same, curve));
  };
  const std::string line = trimmed(step_.line(a, 1, 0), a, b, true, "CARTESIAN");
  const std::string arc = trimmed(circle, b, c, true, "CARTESIAN");
  const std::string named = step_.add("POLYLINE('roof'," + test::StepText::list({c, a}) + ")");
  const std::string wire = step_.add(
      "COMPOSITE_CURVE('wire'," +
      test::StepText::list({segment(line, ".T."), segment(arc, ".T."), segment(named, ".F.")}) + ",.F.)");
  const auto chains = read_items({step_.set({wire})});
  ASSERT_EQ(chains.size(), 3u);
  EXPECT_EQ(chains[0].name, "wire");
  EXPECT_EQ(chains[1].name, "wire");
  EXPECT_EQ(chains[2].name, "roof");
  expect_on_circle(chains[1], {2, 1}, 1);
  Warnings warnings;
  const Geometry geometry = assemble(chains, {}, warnings);
  EXPECT_EQ(geometry.loop_count(), 1);
  EXPECT_EQ(geometry.boundaries().size(), 2u) << "curves of one name are one boundary";
}

TEST_F(StepReader, ReadsAPlanarFaceWithAHole) {
  const std::string face = plate(step_, "plate", "inlet");
  const auto chains = read_items(
      {step_.add("SHELL_BASED_SURFACE_MODEL('',(" + step_.add("OPEN_SHELL('',(" + face + "))") + "))")});
  ASSERT_EQ(chains.size(), 5u);
  EXPECT_EQ(chains[0].name, "plate");
  EXPECT_EQ(chains[1].name, "inlet");
  expect_ends(chains[1], {4, 0}, {4, 2});
  EXPECT_FALSE(chains[4].open);
  expect_on_circle(chains[4], {1, 1}, 0.5);
  EXPECT_TRUE(warnings_.empty());
  Warnings warnings;
  const Geometry geometry = assemble(chains, {}, warnings);
  EXPECT_EQ(geometry.loop_count(), 2);
  EXPECT_TRUE(warnings.empty());
}

TEST_F(StepReader, LeavesOutTheEdgesWithinASheet) {
  std::vector<std::string> v, faces;
  for (const Point p : {Point{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}})
    v.push_back(step_.vertex(p.x, p.y));
  const auto straight = [&](int from, int to, double dx, double dy) {
    return step_.edge(v[from], v[to], step_.line(step_.point(0, 0), dx, dy));
  };
  const std::string common = straight(1, 4, 0, 1),
                    plane = step_.add("PLANE(''," + step_.placement(0, 0) + ")");
  const std::vector<std::string> left{straight(0, 1, 1, 0), common, straight(4, 5, -1, 0),
                                      straight(5, 0, 0, -1)},
      right{straight(1, 2, 1, 0), straight(2, 3, 0, 1), straight(3, 4, -1, 0), common};
  for (const auto& edges : {left, right})
    faces.push_back(step_.add("FACE_SURFACE('',(" +
                              step_.add("FACE_BOUND(''," + step_.loop(edges) + ",.T.)") + ")," + plane +
                              ",.T.)"));
  const auto chains = read_items({step_.add("OPEN_SHELL(''," + test::StepText::list(faces) + ")")});
  EXPECT_EQ(chains.size(), 6u);
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("1 edges between faces of a sheet are left out"), std::string::npos)
      << warnings_[0];
}

TEST_F(StepReader, ReadsWireModelsAndPolyLoops) {
  const std::string a = step_.vertex(0, 0), b = step_.vertex(1, 0), p = step_.point(0, 1),
                    q = step_.point(1, 1), r = step_.point(0.5, 2);
  const std::string edge = step_.edge(a, b, step_.line(step_.point(0, 0), 1, 0));
  const std::string wire = step_.add("WIRE_SHELL('',(" + step_.loop({edge}) + "," +
                                     step_.add("POLY_LOOP('',(" + p + "," + q + "," + r + "))") + "))");
  const auto chains = read_items({step_.add("SHELL_BASED_WIREFRAME_MODEL('',(" + wire + "))"),
                                  step_.add("EDGE_BASED_WIREFRAME_MODEL('',(" +
                                            step_.add("CONNECTED_EDGE_SET('',(" + edge + "))") + "))")});
  ASSERT_EQ(chains.size(), 2u) << "an edge that occurs twice is read once";
  expect_ends(chains[0], {0, 0}, {1, 0});
  EXPECT_EQ(chains[1].points.size(), 3u);
  EXPECT_FALSE(chains[1].open);
}

TEST_F(StepReader, ReadsThePlaneThatTheCurvesAreIn) {
  const auto square = [&](const std::function<std::string(double, double)>& at) {
    test::StepText fresh;
    step_ = fresh;
    const std::string a = at(0, 0), b = at(3, 0), c = at(3, 1);
    return read_items({step_.set({step_.add("POLYLINE('',(" + a + "," + b + "," + c + "," + a + "))")})});
  };
  const std::vector<Point> expected{{0, 0}, {3, 0}, {3, 1}};
  EXPECT_EQ(square([&](double x, double y) { return step_.point(x, y, 7); })[0].points, expected);
  EXPECT_EQ(unit_.plane, "");
  EXPECT_EQ(square([&](double x, double y) { return step_.point(x, -2, y); })[0].points, expected);
  EXPECT_EQ(unit_.plane, "XZ");
  EXPECT_EQ(square([&](double x, double y) { return step_.point(1e-8 * y, x, y); })[0].points, expected);
  EXPECT_EQ(unit_.plane, "YZ");
  EXPECT_EQ(square([&](double x, double y) {
              return step_.add(fmt::format("CARTESIAN_POINT('',({},{}))", x, y));
            })[0]
                .points,
            expected);
}

TEST_F(StepReader, ReadsArcsInOtherPlanes) {
  const std::string place =
      step_.placement(step_.point(1, 5, 2), step_.direction(0, 1, 0), step_.direction(0, 0, 1));
  const std::string circle = step_.add("CIRCLE(''," + place + ",2.)");
  const auto chains = read_items({step_.set(
      {trimmed(circle, "PARAMETER_VALUE(0.)", fmt::format("PARAMETER_VALUE({})", pi / 2), true)})});
  EXPECT_EQ(unit_.plane, "XZ");
  expect_ends(chains[0], {1, 4}, {3, 2});  // from z to y x z = x
  expect_on_circle(chains[0], {1, 2}, 2);
}

TEST_F(StepReader, KnowsTheAxesThatPlacementsLeaveOut) {
  const auto quarter = [&](const std::string& placement) {
    test::StepText only = step_;
    const std::string circle = only.add("CIRCLE(''," + only.add(placement) + ",1.)");
    return read(only.file({only.set({only.add(
        fmt::format("TRIMMED_CURVE('',{},(PARAMETER_VALUE(0.)),(PARAMETER_VALUE({})),.T.,.PARAMETER.)",
                    circle, pi / 2))})}))[0];
  };
  const std::string o = step_.point(0, 0), x = step_.direction(1, 0), y = step_.direction(0, 1);
  expect_ends(quarter("AXIS2_PLACEMENT_3D(''," + o + ",$,$)"), {1, 0}, {0, 1});
  expect_ends(quarter("AXIS2_PLACEMENT_2D(''," + o + ",$)"), {1, 0}, {0, 1});
  expect_ends(quarter("AXIS2_PLACEMENT_2D(''," + o + "," + y + ")"), {0, 1}, {-1, 0});
  expect_ends(quarter("AXIS2_PLACEMENT_3D(''," + o + "," + y + ",$)"), {1, 0}, {0, -1});
  EXPECT_EQ(unit_.plane, "XZ");
  expect_ends(quarter("AXIS2_PLACEMENT_3D(''," + o + "," + x + ",$)"), {1, 0}, {0, 1});
  EXPECT_EQ(unit_.plane, "YZ");
}

TEST_F(StepReader, RefusesCurvesThatAreNotInOnePlane) {
  const auto line = [&](double x, double y, double z) {
    return step_.add("POLYLINE('',(" + step_.point(0, 0, 0) + "," + step_.point(x, y, z) + "))");
  };
  const std::string text = refusal({step_.set({line(1, 0, 0), line(0, 1, 0.5), line(1, 1, 0)})});
  EXPECT_NE(text.find("not in one plane parallel to the XY, XZ or YZ plane"), std::string::npos) << text;
  EXPECT_NE(text.find("POLYLINE #3 has the point (0, 0, 0), and POLYLINE #6 has the point (0, 1, 0.5)"),
            std::string::npos)
      << text;
}

TEST_F(StepReader, NamesCurvesByLayerOrFile) {
  const auto line = [&](const std::string& name, double y) {
    return step_.add(fmt::format("POLYLINE('{}',({},{}))", name, step_.point(0, y), step_.point(1, y)));
  };
  const std::string a = line("own name", 0), b = line("", 1), c = line("NONE", 2), d = line("", 3),
                    e = line("", 4);
  step_.add("PRESENTATION_LAYER_ASSIGNMENT('Wall layer','',(" + a + "," + b + "))");
  const std::string styled = step_.add("STYLED_ITEM('',()," + c + ")");
  step_.add("PRESENTATION_LAYER_ASSIGNMENT('\\X2\\00DC\\X0\\ber','',(" + styled + "))");
  const std::string hidden = step_.add("PRESENTATION_LAYER_ASSIGNMENT('aux','',(" + d + "))");
  step_.add("INVISIBILITY((" + hidden + "))");
  const std::string text = step_.file({step_.set({a, b, c, d, e})});
  auto names = [&] {
    std::vector<std::string> found;
    for (const Chain& chain : read(text)) found.push_back(chain.name);
    return found;
  };
  EXPECT_EQ(names(), (std::vector<std::string>{"own_name", "Wall_layer",
                                               "\xc3\x9c"
                                               "ber",
                                               "part"}));
  EXPECT_EQ(unit_.layers, (std::vector<std::string>{"Wall layer", "aux",
                                                    "\xc3\x9c"
                                                    "ber"}));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("left out: 1 POLYLINE on invisible layer 'aux'"), std::string::npos)
      << warnings_[0];
  choice_.layers = {"AUX", "wall*"};
  EXPECT_EQ(names(), (std::vector<std::string>{"own_name", "Wall_layer", "aux"}));
  choice_.layers = {};
  choice_.names.from = BoundaryNames::From::layer;
  EXPECT_EQ(names(), (std::vector<std::string>{"Wall_layer", "Wall_layer",
                                               "\xc3\x9c"
                                               "ber",
                                               "part"}));
  choice_.names.from = BoundaryNames::From::file;
  EXPECT_EQ(names(), (std::vector<std::string>(4, "part")));
  choice_.layers = {"none"};
  const std::string said = test::refusal(folder_, [&] { read(text); });
  EXPECT_NE(
      said.find(
          "no layer of the file has lines or polygons and is one of [none]; its layers are: Wall layer, aux"),
      std::string::npos)
      << said;
}

/// OpenCASCADE gives edges of a face layers of their own.
TEST_F(StepReader, NamesAndSelectsEdgesOfFacesByTheirLayer) {
  const std::string face = plate(step_, "", "unused");
  step_.add("PRESENTATION_LAYER_ASSIGNMENT('domain','',(" + face + "))");
  const std::string a = step_.vertex(7, 0), b = step_.vertex(8, 0), c = step_.vertex(7, 1);
  const auto straight = [&](const std::string& from, const std::string& to, double dx, double dy) {
    return step_.edge(from, to, step_.line(step_.point(0, 0), dx, dy));
  };
  const std::string first = straight(a, b, 1, 0), second = straight(b, c, -1, 1),
                    third = straight(c, a, 0, -1);
  const std::string bound = step_.add("FACE_BOUND(''," + step_.loop({first, second, third}) + ",.T.)");
  const std::string plane = step_.add("PLANE(''," + step_.placement(0, 0) + ")");
  const std::string triangle = step_.add("ADVANCED_FACE('',(" + bound + ")," + plane + ",.T.)");
  step_.add("PRESENTATION_LAYER_ASSIGNMENT('inlet','',(" + second + "))");
  const std::string text = step_.file({step_.add("OPEN_SHELL('',(" + face + "," + triangle + "))")});
  EXPECT_EQ(read(text).size(), 8u);
  EXPECT_EQ(unit_.layers, (std::vector<std::string>{"domain", "inlet"}));
  choice_.layers = {"inlet"};
  const auto chains = read(text);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].name, "inlet");
  expect_ends(chains[0], {8, 0}, {7, 1});
  choice_.layers = {"domain"};
  EXPECT_EQ(read(text).size(), 5u);
}

TEST_F(StepReader, PassesOverSolidsAndCurvedFacesOfOtherLayers) {
  const std::string cylinder = step_.add("CYLINDRICAL_SURFACE(''," + step_.placement(0, 0) + ",1.)");
  const std::string curved = step_.add("ADVANCED_FACE('',()," + cylinder + ",.T.)"), face = plate(step_);
  step_.add("PRESENTATION_LAYER_ASSIGNMENT('domain','',(" + face + "))");
  choice_.layers = {"domain"};
  EXPECT_EQ(read_items({step_.add("OPEN_SHELL('',(" + face + "," + curved + "))")}).size(), 5u);
}

TEST_F(StepReader, CountsWhatItSkips) {
  const std::string a = step_.point(0, 0), line = step_.line(a, 1, 0);
  const std::string wall = step_.add("POLYLINE('',(" + a + "," + step_.point(1, 1) + "))");
  const std::string zero = trimmed(line, a, a, true, "CARTESIAN");
  const std::string hidden = step_.add("POLYLINE('',(" + a + "," + step_.point(1, 5) + "))");
  step_.add("INVISIBILITY((" + step_.add("STYLED_ITEM('',()," + hidden + ")") + "))");
  read_items({step_.set({a, a, step_.point(2, 2), line, wall, zero, hidden})});
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find(
                "left out: 2 CARTESIAN_POINT, 1 LINE, 1 TRIMMED_CURVE without length, 1 invisible POLYLINE"),
            std::string::npos)
      << warnings_[0];
}

TEST_F(StepReader, ReportsTheUnitAndKeepsTheCoordinates) {
  step_.length_unit = "CONVERSION_BASED_UNIT('INCH'," +
                      step_.add("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4)," +
                                step_.add("(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.))") + ")") +
                      ")";
  const auto chains = read_items(
      {step_.set({step_.add("POLYLINE('',(" + step_.point(0, 0) + "," + step_.point(1, 1) + "))")})});
  EXPECT_EQ(chains[0].points[1], (Point{1, 1}));
  EXPECT_EQ(unit_.name, "inch");
  EXPECT_NEAR(unit_.metres, 0.0254, 1e-17);
}

TEST_F(StepReader, RefusesTwoUnits) {
  const auto line = [&](double y) {
    return step_.add("POLYLINE('',(" + step_.point(0, y) + "," + step_.point(1, y) + "))");
  };
  step_.shape({step_.set({line(0)})});
  step_.length_unit = "SI_UNIT($,.METRE.)";
  const std::string said = refusal({step_.set({line(1)})});
  EXPECT_NE(said.find("is in m, but other parts of the file are in mm; export all in one unit"),
            std::string::npos)
      << said;
}

/// The structure of NASA's file of the three-element section: free named curves with a trailing edge that is
/// shorter than the declared uncertainty.
TEST_F(StepReader, DoesNotJoinByTheDeclaredUncertainty) {
  const auto spline = [&](const std::string& name, const std::vector<Point>& points,
                          const std::string& knots) {
    std::vector<std::string> poles;
    for (const Point p : points) poles.push_back(step_.point(p.x, p.y));
    return step_.add(
        fmt::format("B_SPLINE_CURVE_WITH_KNOTS('{}',{},{},.UNSPECIFIED.,.F.,.F.,{},.UNSPECIFIED.)", name,
                    points.size() - 1, test::StepText::list(poles), knots));
  };
  const std::string top = spline("top", {{1, 4e-4}, {0.5, 0.1}, {0, 0.1}, {0, 0}}, "(4,4),(0.,1.)");
  const std::string bottom = spline("bottom", {{0, 0}, {0, -0.1}, {0.5, -0.05}, {1, -5e-5}}, "(4,4),(0.,1.)");
  const std::string base = spline("TE", {{1, -5e-5}, {1, 4e-4}}, "(2,2),(0.,0.001)");
  const auto chains = read_items({step_.set({top, base, bottom})});  // the uncertainty is 1
  ASSERT_EQ(chains.size(), 3u);
  EXPECT_EQ(chains[1].name, "TE");
  EXPECT_EQ(chains[0].points.back(), (Point{0, 0}));
  EXPECT_EQ(chains[2].points.back(), (Point{1, -5e-5})) << "ends are control points, to the bit";
  Warnings warnings;
  AssembleOptions options;
  options.domain_is_known = true;
  const Geometry geometry = assemble(chains, options, warnings);
  EXPECT_EQ(geometry.boundaries().size(), 3u);
  EXPECT_TRUE(warnings.empty());
}

TEST_F(StepReader, RefusesSolidsAndCurvedFaces) {
  const std::string face = plate(step_), other = plate(step_);
  const std::string shell = step_.add("CLOSED_SHELL('',(" + face + "," + other + "))");
  const std::string solid = step_.add("MANIFOLD_SOLID_BREP('body'," + shell + ")");
  const std::string cylinder = step_.add("CYLINDRICAL_SURFACE(''," + step_.placement(0, 0) + ",1.)");
  const std::string curved = step_.add("ADVANCED_FACE('',()," + cylinder + ",.T.)");
  test::StepText round = step_;
  EXPECT_NE(refusal({solid}).find("MANIFOLD_SOLID_BREP #"), std::string::npos);
  EXPECT_NE(refusal({solid}).find(
                "is a solid with 2 faces, but the geometry must be plane; export one planar face"),
            std::string::npos);
  step_ = round;
  EXPECT_NE(refusal({curved}).find("lies on a CYLINDRICAL_SURFACE #"), std::string::npos);
}

/// An assembly of a line from (0, 0) to (1, 0): `place` moves it by (5, 1) and turns it by 90 degrees.
struct Assembly {
  std::string line, here, place, part, whole, part_product, whole_product;

  explicit Assembly(test::StepText& step) {
    line = step.add("POLYLINE('',(" + step.point(0, 0) + "," + step.point(1, 0) + "))");
    here = step.placement(0, 0);
    place = step.placement(step.point(5, 1), step.direction(0, 0, 1), step.direction(0, 1));
    part = step.shape({line, here});
    whole = step.shape({here, place});
    part_product = product(step, part);
    whole_product = product(step, whole);
  }
  static std::string product(test::StepText& step, const std::string& shape) {
    const std::string product = step.add("PRODUCT_DEFINITION('','',$,$)");
    step.add("SHAPE_DEFINITION_REPRESENTATION(" +
             step.add("PRODUCT_DEFINITION_SHAPE('',''," + product + ")") + "," + shape + ")");
    return product;
  }
  void relate(test::StepText& step, const std::string& first, const std::string& second,
              const std::string& from, const std::string& to) const {
    const std::string relation =
        step.add("(REPRESENTATION_RELATIONSHIP('',''," + first + "," + second +
                 ") REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(" +
                 step.add("ITEM_DEFINED_TRANSFORMATION('',''," + from + "," + to + ")") +
                 ") SHAPE_REPRESENTATION_RELATIONSHIP())");
    const std::string usage =
        step.add("NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','',''," + whole_product + "," + part_product + ",$)");
    step.add("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(" + relation + "," +
             step.add("PRODUCT_DEFINITION_SHAPE('',''," + usage + ")") + ")");
  }
};

TEST_F(StepReader, ReadsThePartsOfAssembliesAtTheirPlaces) {
  const Assembly assembly(step_);
  const test::StepText parts = step_;
  assembly.relate(step_, assembly.part, assembly.whole, assembly.here, assembly.place);
  auto chains = read(step_.text());
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].points, (std::vector<Point>{{5, 1}, {5, 2}}));
  step_ = parts;
  assembly.relate(step_, assembly.whole, assembly.part, assembly.place, assembly.here);  // in the other order
  chains = read(step_.text());
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].points, (std::vector<Point>{{5, 1}, {5, 2}}));
  assembly.relate(step_, assembly.part, assembly.whole, assembly.here, assembly.here);
  chains = read(step_.text());
  ASSERT_EQ(chains.size(), 2u) << "a part may be used twice";
  EXPECT_EQ(chains[1].points, (std::vector<Point>{{0, 0}, {1, 0}}));
}

TEST_F(StepReader, ReadsPartsOfParts) {
  const Assembly assembly(step_);
  assembly.relate(step_, assembly.part, assembly.whole, assembly.here, assembly.place);
  const std::string above = step_.shape({});
  const std::string twin = step_.shape({assembly.here});
  step_.add("SHAPE_REPRESENTATION_RELATIONSHIP('',''," + twin + "," + assembly.whole + ")");
  const std::string map = step_.add("REPRESENTATION_MAP(" + assembly.here + "," + twin + ")");
  const auto chains = read_items({step_.add("MAPPED_ITEM(''," + map + "," + assembly.place + ")")});
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].points, (std::vector<Point>{{4, 6}, {3, 6}})) << "turned twice";
}

TEST_F(StepReader, MovesAllKindsOfCurves) {
  const std::string circle = step_.add("CIRCLE(''," + step_.placement(1, 0) + ",2.)");
  const std::string part = step_.shape({circle});
  const std::string map = step_.add("REPRESENTATION_MAP(" + step_.placement(0, 0) + "," + part + ")");
  const std::string place =
      step_.placement(step_.point(0, 0, 3), step_.direction(0, 1, 0), step_.direction(1, 0));
  const auto chains = read_items({step_.add("MAPPED_ITEM(''," + map + "," + place + ")")});
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(unit_.plane, "XZ");
  expect_on_circle(chains[0], {1, 3}, 2);
}

TEST_F(StepReader, RefusesCopiesBeyondMemory) {
  const Assembly assembly(step_);
  std::vector<std::string> points;
  for (int i = 0; i < 15000; ++i) points.push_back(step_.point(i, i % 7));
  const std::string part = step_.shape({step_.add("POLYLINE(''," + test::StepText::list(points) + ")")});
  for (int i = 0; i < 700; ++i) assembly.relate(step_, part, assembly.whole, assembly.here, assembly.here);
  const std::string said = test::refusal(folder_, [&] { read(step_.text()); });
  EXPECT_NE(said.find("has 700 places in an assembly, which makes more than 1e7 points"), std::string::npos)
      << said;
}

TEST_F(StepReader, RefusesEndlessAndScaledAssemblies) {
  Assembly assembly(step_);
  const test::StepText parts = step_;
  const auto said = [&] { return test::refusal(folder_, [&] { read(step_.text()); }); };
  assembly.relate(step_, assembly.part, assembly.whole, assembly.here, assembly.place);
  step_.add("SHAPE_REPRESENTATION_RELATIONSHIP('',''," + assembly.whole + "," + assembly.part + ")");
  EXPECT_NE(said().find("is part of an assembly that contains itself"), std::string::npos);
  step_ = parts;
  for (int i = 0; i < 400; ++i)
    assembly.relate(step_, assembly.part, assembly.whole, assembly.here, assembly.here);
  std::swap(assembly.part_product, assembly.whole_product);
  const std::string above = step_.shape({});
  assembly.whole_product = Assembly::product(step_, above);
  for (int i = 0; i < 400; ++i) assembly.relate(step_, assembly.whole, above, assembly.here, assembly.here);
  EXPECT_NE(said().find("is part of an assembly with more than 100000 parts"), std::string::npos);
  step_ = parts;
  const std::string map = step_.add("REPRESENTATION_MAP(" + assembly.here + "," + assembly.part + ")");
  const std::string scaled =
      step_.add("CARTESIAN_TRANSFORMATION_OPERATOR_3D('',$,$," + step_.point(0, 0) + ",2.,$)");
  EXPECT_NE(refusal({step_.add("MAPPED_ITEM(''," + map + "," + scaled + ")")})
                .find("moves a part by a CARTESIAN_TRANSFORMATION_OPERATOR_3D"),
            std::string::npos);
}

TEST_F(StepReader, RefusesDamagedAndEndlessEntities) {
  const auto said = [&](const std::string& record, const std::string& expected) {
    test::StepText fresh;
    step_ = fresh;
    const std::string a = step_.point(0, 0), b = step_.point(1, 0), place = step_.placement(0, 0);
    const std::string text = refusal({step_.add(record)});
    EXPECT_NE(text.find(expected), std::string::npos) << text;
  };
  // #1, #2: points; #6: a placement; #7: the entity itself.
  said("TRIMMED_CURVE('',#7,(#1),(#2),.T.,.CARTESIAN.)", "TRIMMED_CURVE #7: refers to itself");
  said("SURFACE_CURVE('',#7,(),.CURVE_3D.)", "SURFACE_CURVE #7: refers to itself");
  said("COMPOSITE_CURVE('',(#7),.F.)",
       "COMPOSITE_CURVE #7: an entity COMPOSITE_CURVE_SEGMENT is expected here");
  said("GEOMETRIC_SET('',(#99))", "GEOMETRIC_SET #7: refers to #99, which is not in the file");
  said("CIRCLE('',#6,-1.)", "CIRCLE #7: a radius is not positive");
  said("CIRCLE('',#1,1.)", "CARTESIAN_POINT #1: an entity AXIS2_PLACEMENT_3D is expected here");
  said("POLYLINE('',(#1,#1))", "POLYLINE #7: has fewer than two different points");
  said("B_SPLINE_CURVE_WITH_KNOTS('',1,(#1,#2),.U.,.F.,.F.,(2,1000000000),(0.,1.),.U.)",
       "do not make 4 knots");
  said("B_SPLINE_CURVE_WITH_KNOTS('',1,(#1,#2),.U.,.F.,.F.,(2,2),(1.,0.),.U.)",
       "its knots are not in ascending order");
  said("B_SPLINE_CURVE_WITH_KNOTS('',1000000000,(#1,#2),.U.,.F.,.F.,(2,2),(0.,1.),.U.)",
       "its degree 1000000000 does not suit 2");
  said("BEZIER_CURVE('',2,(#1,#2,#1,#2),.U.,.F.,.F.)", "control points of degree 2 need 7");
  said("EDGE_CURVE('',#1,#2,#6,.T.)", "AXIS2_PLACEMENT_3D #6: curves of this type are not read");
  said("POLYLINE('',(#1,#6))", "AXIS2_PLACEMENT_3D #6: an entity CARTESIAN_POINT is expected here");
}

TEST_F(StepReader, RefusesAnEdgeWhoseVertexIsFarFromItsCurve) {
  const std::string circle = step_.add("CIRCLE(''," + step_.placement(0, 0) + ",1.)");
  const auto edge = [&](double off) {
    test::StepText only = step_;
    const std::string e = only.edge(only.vertex(1 + off, 0), only.vertex(0, 1 + off), circle);
    return only.file({only.add("CONNECTED_EDGE_SET('',(" + e + "))")});
  };
  EXPECT_EQ(read(edge(1e-5))[0].points.front(), (Point{1 + 1e-5, 0}));
  EXPECT_EQ(read(edge(1e-5))[0].points.back(), (Point{0, 1 + 1e-5}));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("vertices are up to 1e-05 off the curves of their edges"), std::string::npos)
      << warnings_[0];
  const std::string said = test::refusal(folder_, [&] { read(edge(0.1)); });
  EXPECT_NE(said.find("its end (1.1, 0, 0) is 0.1 off the curve, which ends at (1, 0, 0)"), std::string::npos)
      << said;
}

TEST_F(StepReader, RefusesFilesWithoutCurves) {
  EXPECT_NE(refusal({}).find("part.stp: holds no lines and no polygons"), std::string::npos);
  EXPECT_NE(refusal({step_.point(0, 0)}).find("Left out: 1 CARTESIAN_POINT"), std::string::npos);
}

/// Curves that contain each other twice would be read 2^n times.
TEST_F(StepReader, ReadsEachItemOnce) {
  std::string curve = step_.add("POLYLINE('',(" + step_.point(0, 0) + "," + step_.point(1, 0) + "))");
  for (int i = 0; i < 28; ++i) {
    const std::string segment = step_.add("COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.," + curve + ")");
    curve = step_.add("COMPOSITE_CURVE('',(" + segment + "," + segment + "),.F.)");
  }
  EXPECT_EQ(read_items({step_.set({curve})}).size(), 1u);
  for (int i = 0; i < 40; ++i) curve = step_.set({curve});
  EXPECT_NE(refusal({curve}).find("nested too deep"), std::string::npos);
}

}  // namespace
}  // namespace quadloop::io
