#include "io/input/airfoil_dat.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/io/input/airfoil_rows.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop::io {
namespace {

using test::airfoil_name;
using test::lednicer_rows;
using test::lower_rows;
using test::selig_rows;
using test::upper_rows;

/// Files as the collections of airfoils hold them.
class AirfoilDat : public ::testing::Test {
 protected:
  std::vector<Point> read(const std::string& text) {
    warnings_.clear();
    const std::vector<Chain> chains = read_airfoil(folder_.write("a.dat", text), warnings_);
    EXPECT_EQ(chains.size(), 1u);
    return chains.front().points;
  }

  /// The airfoil, and one warning that holds these pieces.
  void expect_airfoil(const std::string& text, const std::vector<std::string>& pieces) {
    const std::vector<Point> wanted = read(airfoil_name + selig_rows);
    ASSERT_TRUE(warnings_.empty());
    EXPECT_EQ(read(text), wanted) << text;
    ASSERT_EQ(warnings_.size(), pieces.empty() ? 0u : 1u) << text;
    for (const std::string& piece : pieces)
      EXPECT_NE(warnings_[0].find(piece), std::string::npos) << piece << " in " << warnings_[0];
  }

  std::string refused(const std::string& text) {
    return test::refusal(folder_, [&] { read(text); });
  }

  test::InputFolder folder_;
  std::vector<std::string> warnings_;
};

TEST_F(AirfoilDat, PassesOverTextAfterThePoints) {
  for (const std::string& points : {selig_rows, lednicer_rows}) {
    expect_airfoil(airfoil_name + points + "\nWortmann, 1978\nt/c = 12 percent\n",
                   {"2 rows beside the name that are no points of the airfoil", "'Wortmann, 1978'"});
    expect_airfoil(airfoil_name + points + "12 percent thick\n",
                   {"1 row beside the name", "'12 percent thick'", "was ignored"});
    expect_airfoil(airfoil_name + points + "x t\n0.5 0.12\n0.7 0.08\n", {"3 rows", "'x t'"});
    expect_airfoil(airfoil_name + points + "\x1a\n", {});
    expect_airfoil(airfoil_name + points + "\n\n \t\r\n", {});
  }
}

TEST_F(AirfoilDat, PassesOverASecondRowInTheHead) {
  for (const std::string& points : {selig_rows, lednicer_rows}) {
    expect_airfoil(airfoil_name + "designed for Re = 1e6\n\n" + points,
                   {"a.dat:2: 1 row beside the name that is no point", "'designed for Re = 1e6'"});
    expect_airfoil(airfoil_name + "12 percent, symmetric\nX Y\n" + points, {"a.dat:2: 2 rows"});
  }
}

TEST_F(AirfoilDat, PassesOverWhatFollowsAWholeAirfoilAfterABlankRow) {
  expect_airfoil(airfoil_name + selig_rows + "\n" + selig_rows, {"a.dat:8: 5 rows", "'1.0 0.0'"});
  expect_airfoil(airfoil_name + lednicer_rows + "\n0.0 0.0\n0.5 0.12\n1.0 0.0\n", {"3 rows"});
}

TEST_F(AirfoilDat, PassesOverWordsBetweenTheSurfaces) {
  expect_airfoil(airfoil_name + "3. 3.\nupper surface\n" + upper_rows + "lower surface\n" + lower_rows,
                 {"2 rows", "'upper surface'"});
}

TEST_F(AirfoilDat, ReadsEveryOtherRowBlank) {
  expect_airfoil(airfoil_name + "\n1.0 0.0\n\n0.5 0.06\n\n0.0 0.0\n\n0.5 -0.06\n\n1.0 0.0\n", {});
}

TEST_F(AirfoilDat, TakesTwoSurfacesWithoutCounts) {
  expect_airfoil(airfoil_name + upper_rows + "\n" + lower_rows,
                 {"both surfaces run from the leading edge", "point 4 begins the second"});
}

TEST_F(AirfoilDat, TakesTwoSurfacesFromTheTrailingEdge) {
  expect_airfoil(airfoil_name + "1.0 0.0\n0.5 0.06\n0.0 0.0\n1.0 0.0\n0.5 -0.06\n0.0 0.0\n",
                 {"both surfaces run from the trailing edge", "point 4"});
}

TEST_F(AirfoilDat, TakesAThirdColumnOfZeros) {
  expect_airfoil(airfoil_name + "1.0 0.0 0.0\n0.5 0.06 0\n0.0 0.0 0.0\n0.5 -0.06 0.0\n1.0 0.0 0.0\n", {});
}

TEST_F(AirfoilDat, ReadsOldLineEndsAndWideCharacters) {
  std::string text = airfoil_name + selig_rows, wide = "\xFF\xFE";
  for (const char c : text) wide += {c, '\0'};
  expect_airfoil(wide, {});
  expect_airfoil(wide.substr(2), {});
  std::string high_first;
  for (const char c : text) high_first += {'\0', c};
  expect_airfoil(high_first, {});
  std::ranges::replace(text, '\n', '\r');
  expect_airfoil(text, {});
}

TEST_F(AirfoilDat, RefusesWhatIsOpenOverMostOfTheChord) {
  const std::string reference = refused(airfoil_name + "0.25 0.0\n" + selig_rows);
  EXPECT_NE(reference.find("0.75 apart, too far for a trailing edge"), std::string::npos) << reference;
  EXPECT_NE(refused(airfoil_name + "1.0 0.0\n0.5 0.06\n0.0 0.0\n").find("surface that is missing"),
            std::string::npos);
}

TEST_F(AirfoilDat, RefusesABrokenPoint) {
  EXPECT_EQ(refused(airfoil_name + "1.0 0.0\n0.5 O.06\n0.0 0.0\n").find("a.dat:3: 'O.06' is not a number"),
            0u);
  EXPECT_EQ(refused(airfoil_name + "1.0 0.0\n0.5 0.06 0.1\n0.0 0.0\n")
                .find("a.dat:3: '0.5 0.06 0.1' should be two coordinates"),
            0u);
  EXPECT_EQ(refused(airfoil_name + "3. 3.\n" + upper_rows + lower_rows + "0.5 0.1\n")
                .find("a.dat:9: the file has 7 points, but its header (Lednicer format) counts 3 and 3"),
            0u);
  EXPECT_EQ(refused(airfoil_name + "3. 4.\n" + upper_rows + lower_rows + "the end\n")
                .find("a.dat:9: the file has 6 points"),
            0u);
}

TEST_F(AirfoilDat, ReadsAFirstPointOfTwoIntegers) {
  const std::string rest = "500.5 60.0\n0.0 0.0\n500.5 -60.0\n";
  const std::vector<Point> points = read(airfoil_name + "1000.000 2.000\n" + rest + "1000.000 -2.000\n");
  EXPECT_EQ(points.size(), 5u) << "a blunt airfoil in millimetres";
  EXPECT_NE(std::ranges::find(points, Point{1000, 2}), points.end());
  EXPECT_EQ(read(airfoil_name + "1000.000 2.000\n" + rest + "1000.000 2.000\n").size(), 4u);
  EXPECT_EQ(refused(airfoil_name + "1000.000 2.000\n" + rest).find("a.dat:5: the file has 3 points"), 0u)
      << "the last row does not return to it";
}

TEST_F(AirfoilDat, PassesOverTheBoxOfAGridForMses) {
  expect_airfoil(airfoil_name + "-1.5 3.0 -2.0 2.5\n" + selig_rows, {});
  EXPECT_EQ(refused(airfoil_name + "-1.5 3.0 -2.0 2.5\n-1.5 3.0 -2.0 2.5\n" + selig_rows).find("a.dat:3: "),
            0u)
      << "only the second row is one";
  EXPECT_EQ(refused(airfoil_name + "-1.5 3.0 -2.0 2.5 1\n" + selig_rows).find("a.dat:2: "), 0u);
}

TEST_F(AirfoilDat, GivesEachElementALoopOfItsOwn) {
  const std::string flap = "1.4 -0.1\n1.2 -0.02\n1.0 -0.05\n1.2 -0.08\n1.4 -0.1\n";
  for (const std::string& box : {std::string(), std::string("-1.5 3.0 -2.0 2.5\n")}) {
    for (const std::string end : {"", "999.0 999.0\n"}) {
      const std::vector<Chain> chains = read_airfoil(
          folder_.write("a.dat", airfoil_name + box + selig_rows + "999.0 999.0\n" + flap + end), warnings_);
      ASSERT_EQ(chains.size(), 2u);
      EXPECT_EQ(chains[0].name, "airfoil_1");
      EXPECT_EQ(chains[1].name, "airfoil_2");
      EXPECT_EQ(chains[0].points, read(airfoil_name + selig_rows));
      EXPECT_EQ(chains[1].points, read(airfoil_name + flap));
      EXPECT_TRUE(warnings_.empty());
    }
  }
}

TEST_F(AirfoilDat, ReadsWhatItWrites) {
  const std::vector<Point> points{{1, 0.001}, {0.1 + 0.2, 0.06}, {-1e-17, 0}, {1.0 / 3, -0.05}, {1, -0.001}};
  const std::string text = airfoil_text("2412", points);
  EXPECT_EQ(text.substr(0, 13), "2412\n1 0.001\n");
  EXPECT_EQ(read(text), std::vector<Point>(points.rbegin(), points.rend())) << "clockwise";
  EXPECT_TRUE(warnings_.empty());
}

}  // namespace
}  // namespace quadloop::io
