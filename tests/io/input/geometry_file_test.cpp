#include "io/input/geometry_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <clocale>
#include <filesystem>

#include "io/input/geom_text.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "tests/io/input/airfoil_rows.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop::io {
namespace {

class GeometryFile : public ::testing::Test {
 protected:
  std::vector<Chain> read(const std::string& name, const std::string& text) {
    std::vector<std::string> warnings;
    return read_geometry(folder_.write(name, text), warnings);
  }
  std::string refused(const std::string& name, const std::string& text) {
    return test::refusal(folder_, [&] { read(name, text); });
  }

  test::InputFolder folder_;
};

TEST_F(GeometryFile, ReadsClosedAndOpen) {
  const auto chains = read("a.geom", "# a comment\n2\nbody\n3\n0 0\n1 0\n0 1\ncoast open\n2\n5 5\n6 5\n");
  ASSERT_EQ(chains.size(), 2u);
  EXPECT_EQ(chains[0].name, "body");
  EXPECT_FALSE(chains[0].open);
  EXPECT_EQ(chains[0].points, (std::vector<Point>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_EQ(chains[1].name, "coast");
  EXPECT_TRUE(chains[1].open);
  EXPECT_NE(chains[1].source.find("a.geom:8"), std::string::npos);
}

TEST_F(GeometryFile, TakesWhatOtherProgramsWrite) {
  const auto chains =
      read("a.geom",
           "\xEF\xBB\xBF"
           "1 # boundaries\r\n\r\n  body\t\r\n# points\r\n3\r\n+0.5D+00 -1.0d0\r\n 1E0  0.\r\n.5 1e-400\r\n");
  EXPECT_EQ(chains[0].points, (std::vector<Point>{{0.5, -1}, {1, 0}, {0.5, 0}}));
}

TEST_F(GeometryFile, DoesNotHangOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "no locale with decimal commas here";
  const auto chains = read("a.geom", "1\nbody\n3\n0.5 0\n1 0\n0 1\n");
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_EQ(chains[0].points[0].x, 0.5);
}

TEST_F(GeometryFile, RefusesWithTheLine) {
  EXPECT_EQ(refused("a.geom", "one\n").find("a.geom:1: 'one' is not a number of boundaries"), 0u);
  EXPECT_EQ(refused("a.geom", "0\n").find("a.geom:1: '0' is not a number of boundaries"), 0u);
  EXPECT_EQ(refused("a.geom", "1\nmy body\n").find("a.geom:2: 'my body' is not a boundary's name"), 0u);
  EXPECT_EQ(
      refused("a.geom", "1\nbody\n-3\n").find("a.geom:3: '-3' is not a number of points of boundary 'body'"),
      0u);
  EXPECT_EQ(refused("a.geom", "1\nbody\n3\n0 0\n1 x\n").find("a.geom:5: 'x' is not a number"), 0u);
  EXPECT_EQ(refused("a.geom", "1\nbody\n3\n0 0\n1 nan\n").find("a.geom:5: 'nan' is not a finite number"), 0u);
  EXPECT_EQ(refused("a.geom", "1\nbody\n3\n0 0\n1 -inf\n").find("a.geom:5: '-inf' is not a finite number"),
            0u);
  EXPECT_EQ(refused("a.geom", "1\nbody\n3\n0 0\n1 1e999\n").find("a.geom:5: '1e999' is not a finite number"),
            0u);
  EXPECT_EQ(refused("a.geom", "1\nbody\n3\n0 0\n1 0 0\n").find("a.geom:5: point 2 of 3 of boundary 'body'"),
            0u);
  EXPECT_EQ(refused("a.geom", "1\nbody\n3\n0 0\n1 0\n")
                .find("a.geom:5: the file ends here, but point 3 of 3 of boundary 'body'"),
            0u);
  EXPECT_EQ(refused("a.geom", "2\nbody\n3\n0 0\n1 0\n0 1\n")
                .find("a.geom:6: the file ends here, but the name of boundary 2 of 2"),
            0u);
  EXPECT_EQ(refused("a.geom", "1\nbody\n3\n0 0\n1 0\n0 1\n0 2\n").find("a.geom:7: more text"), 0u);
  EXPECT_EQ(refused("a.geom", "1 2\nbody\n3\n").find("a.geom:1: "), 0u);
  EXPECT_EQ(refused("a.geom", "").find("a.geom:0: the file ends here"), 0u);
  EXPECT_EQ(refused("a.stl", "").find("a.stl: '.stl' is not the suffix"), 0u);
}

TEST_F(GeometryFile, RefusesAMissingFile) {
  std::vector<std::string> warnings;
  for (const char* name : {"none.geom", "none.dat", "none.dxf", "none.stp"}) {
    const std::string message =
        test::refusal(folder_, [&] { read_geometry((folder_.path() / name).string(), warnings); });
    EXPECT_EQ(message.find(std::string(name) + ": "), 0u) << message;
  }
}

TEST_F(GeometryFile, ReadsStepFilesByBothSuffixes) {
  for (const char* name : {"a.stp", "b.step", "C.STP"}) {
    const auto chains =
        read(name,
             "ISO-10303-21;DATA;#1=CARTESIAN_POINT('',(0.,0.));#2=CARTESIAN_POINT('',(1.,2.));"
             "#3=POLYLINE('',(#1,#2));#4=SHAPE_REPRESENTATION('',(#3),$);ENDSEC;END-ISO-10303-21;");
    ASSERT_EQ(chains.size(), 1u);
    EXPECT_EQ(chains[0].points, (std::vector<Point>{{0, 0}, {1, 2}}));
    EXPECT_TRUE(has_layers_of_drawings(name));
  }
}

TEST_F(GeometryFile, ReadsSelig) {
  const auto chains = read("a.dat", test::airfoil_name + test::selig_rows);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].name, "airfoil");
  EXPECT_FALSE(chains[0].open);
  EXPECT_EQ(chains[0].points.size(), 4u) << "the trailing edge once";
  EXPECT_LT(chains[0].points[0].y, 0) << "the outside to the left";
}

TEST_F(GeometryFile, ReadsABluntTrailingEdge) {
  const auto chains = read("a.dat", "NACA 0012\n1.0 0.01\n0.5 0.06\n0.0 0.0\n0.5 -0.06\n1.0 -0.01\n");
  EXPECT_EQ(chains[0].points.size(), 5u);
}

TEST_F(GeometryFile, ReadsLednicer) {
  const auto lednicer = read("a.dat", test::airfoil_name + test::lednicer_rows);
  const auto selig = read("b.dat", test::airfoil_name + test::selig_rows);
  EXPECT_EQ(lednicer[0].points, selig[0].points);
}

TEST_F(GeometryFile, RefusesBadAirfoils) {
  EXPECT_EQ(refused("a.dat", "name\n3. 4.\n0 0\n1 0\n")
                .find("a.dat:4: the file has 2 points, but its header (Lednicer format) counts 3 and 4"),
            0u);
  EXPECT_EQ(refused("a.dat", "name\n1.0 0.0\n0.5 x\n").find("a.dat:3: 'x' is not a number"), 0u);
  EXPECT_EQ(refused("a.dat", "name\n").find("a.dat:1: the file ends here"), 0u);
}

Geometry assembled(std::vector<Chain> chains) {
  Warnings warnings;
  return assemble(std::move(chains), {}, warnings);
}

TEST_F(GeometryFile, WritesWhatItReads) {
  const std::string text =
      "3\nsea open\n3\n-9 -9\n9.1 -9\n9.1 9\ncoast open\n3\n9.1 9\n-9 9\n-9 -9\nisland\n4\n0 0\n0 1\n1 1\n1 "
      "0\n";
  const Geometry first = assembled(read("a.geom", text));
  const Geometry second = assembled(read("b.geom", geom_text(first)));
  EXPECT_EQ(first.digest(), second.digest());
  EXPECT_EQ(geom_text(first), geom_text(second));
}

TEST_F(GeometryFile, WritesEachRunOfABoundaryAsAChain) {
  const std::string text =
      "4\na open\n2\n0 0\n1 0\nb open\n2\n1 0\n1 1\na open\n2\n1 1\n0 1\nb open\n2\n0 1\n0 0\n";
  const std::string written = geom_text(assembled(read("a.geom", text)));
  EXPECT_NE(written.find("\n4\na open\n"), std::string::npos) << written;
}

TEST_F(GeometryFile, ReadsTheShippedGulfQuickly) {
  for (const char* name : {"high", "medium", "coarse"}) {
    const std::string path = fmt::format(QUADLOOP_SOURCE_DIR "/../shared/data/gulf_of_mexico_{}.geom", name);
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the data folder is not here";
    std::vector<std::string> warnings;
    const Geometry gulf = assembled(read_geometry(path, warnings));
    EXPECT_EQ(gulf.loop_count(), 134);
    EXPECT_TRUE(warnings.empty());
  }
}

TEST_F(GeometryFile, CurvesAreWrittenAndReadAgain) {
  const std::string text =
      "2\nbox\n4\n-3 -3\n3 -3\n3 3\n-3 3\nlens\n2\n1 0 curve 1 -1 -1 -1 weights 1 0.5 0.5 1\n-1 0 curve 0 1 "
      "spacing 0.25\n";
  const Geometry first = assembled(read("a.geom", text));
  ASSERT_TRUE(first.has_curves());
  const Geometry second = assembled(read("b.geom", geom_text(first)));
  EXPECT_EQ(second.digest(), first.digest());
  EXPECT_EQ(geom_text(second), geom_text(first));
}

TEST_F(GeometryFile, FaultsOfCurvesAreNamed) {
  const auto with = [](const std::string& row) { return "1\nlens\n3\n1 0 " + row + "\n-1 0\n0 1\n"; };
  EXPECT_NE(refused("a.geom", with("curve")).find("control points"), std::string::npos);
  EXPECT_NE(refused("a.geom", with("curve 1")).find("two numbers"), std::string::npos);
  EXPECT_NE(refused("a.geom", with("curve 1 2 weights 1 1")).find("needs 3 weights"), std::string::npos);
  EXPECT_NE(refused("a.geom", with("curve 1 2 weights 1 0 1")).find("above 0"), std::string::npos);
  EXPECT_NE(refused("a.geom", with("curve 1 2 spacing")).find("'spacing' is not part of a curve"),
            std::string::npos);
  EXPECT_NE(refused("a.geom", "1\nlens open\n2\n1 0\n-1 0 curve 0 1\n").find("begins no curve"),
            std::string::npos);
}

}  // namespace
}  // namespace quadloop::io
