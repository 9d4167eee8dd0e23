#include "io/gis/ogr_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <tuple>

#include "io/gis/gis_formats.hpp"
#include "io/input/geometry_file.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop::io {
namespace {

class OgrReader : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { add_gis_formats(); }
  std::vector<Chain> read(const std::string& name, const std::string& text) {
    return read_ogr(folder_.write(name, text), layers_, warnings_, unit_);
  }

  test::InputFolder folder_;
  LayerNames layers_;
  std::vector<std::string> warnings_;
  FileUnit unit_;
};

std::string feature(const std::string& properties, const std::string& type, const std::string& coordinates) {
  return fmt::format(
      R"({{"type":"Feature","properties":{{{}}},"geometry":{{"type":"{}","coordinates":{}}}}})", properties,
      type, coordinates);
}

std::string collection(const std::string& features) {
  return R"({"type":"FeatureCollection","features":[)" + features + "]}";
}

TEST_F(OgrReader, RefusesADrawingThatEndsWithinASection) {
  const auto said = [&](const std::string& text) -> std::string {
    try {
      read("d.dxf", text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  const std::string open = "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n0\n20\n0\n11\n1\n21\n1\n0\n";
  EXPECT_NE(said(open + "EOF\n").find("d.dxf:17: section ENTITIES does not end with ENDSEC"),
            std::string::npos)
      << said(open + "EOF\n");
  EXPECT_NE(said(open + "SECTION\n2\nOBJECTS\n0\nENDSEC\n0\nEOF\n").find("does not end"), std::string::npos);
  EXPECT_NE(said(open + "ENDSEC\nzero\nEOF\n").find("d.dxf:19: a group code is expected"), std::string::npos);
  EXPECT_NE(said("2\n0\n").find("d.dxf:3: there is no SECTION"), std::string::npos) << said("2\n0\n");
  EXPECT_EQ(said(open + "ENDSEC\n0\nEOF\n"), "");
}

TEST_F(OgrReader, ReadsLinesAndPolygonsOfGeojson) {
  const std::string line = feature(R"("name":"coast line")", "LineString", "[[0,0],[1,0],[1,1]]");
  const std::string loop = feature(R"("boundary":"island")", "LineString", "[[5,5],[6,5],[6,6],[5,5]]");
  const std::string polygon =
      feature(R"("name":"lake")", "Polygon", "[[[0,0],[9,0],[9,9],[0,0]],[[2,1],[3,1],[3,2],[2,1]]]");
  const std::string many =
      feature("", "MultiPolygon", "[[[[0,0],[9,0],[9,9],[0,0]]],[[[20,0],[29,0],[29,9],[20,0]]]]");
  const std::string dot = feature(R"("name":"buoy")", "Point", "[1,1]");
  const auto chains =
      read("a.geojson", collection(line + "," + loop + "," + polygon + "," + many + "," + dot));
  ASSERT_EQ(chains.size(), 6u);
  EXPECT_EQ(chains[0].name, "coast_line");
  EXPECT_TRUE(chains[0].open);
  EXPECT_EQ(chains[1].name, "island");
  EXPECT_FALSE(chains[1].open);
  EXPECT_EQ(chains[1].points.size(), 3u) << "the first point is not repeated";
  EXPECT_EQ(chains[2].name, "lake");
  EXPECT_EQ(chains[3].name, "lake");
  EXPECT_EQ(chains[4].name, "a") << "named by the layer";
  ASSERT_EQ(warnings_.size(), 2u);
  EXPECT_NE(warnings_[1].find("left out: 1"), std::string::npos);
}

TEST_F(OgrReader, WarnsOfDegrees) {
  const std::string isle = feature("", "Polygon", "[[[10,59],[11,59],[11,61],[10,59]]]");
  read("fjord.geojson", collection(isle));
  ASSERT_EQ(warnings_.size(), 1u);
  for (const char* piece :
       {"fjord.geojson: its coordinates are degrees", "at latitude 60.0", "0.50 of one along y",
        "ogr2ogr -t_srs EPSG:32632 projected.gpkg fjord.geojson"}) {
    EXPECT_NE(warnings_[0].find(piece), std::string::npos) << piece << " in " << warnings_[0];
  }
  warnings_.clear();
  const std::string projected = R"("crs":{"type":"name","properties":{"name":"EPSG:32632"}},)";
  read("fjord.geojson", R"({"type":"FeatureCollection",)" + projected + R"("features":[)" + isle + "]}");
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
  read("metres.geojson", collection(feature("", "Polygon", "[[[0,0],[900,0],[900,900],[0,0]]]")));
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
}

std::string dxf_line(const std::string& layer, double x0, double y0, double x1, double y1) {
  return fmt::format("  0\nLINE\n  8\n{}\n 10\n{}\n 20\n{}\n 30\n0.0\n 11\n{}\n 21\n{}\n 31\n0.0\n", layer,
                     x0, y0, x1, y1);
}

TEST_F(OgrReader, ReadsDxfLinesByLayer) {
  const std::string text = "  0\nSECTION\n  2\nENTITIES\n" + dxf_line("wall", 0, 0, 1, 0) +
                           dxf_line("wall", 1, 1, 1, 0) + dxf_line("inlet", 0, 0, 1, 1) +
                           "  0\nENDSEC\n  0\nEOF\n";
  const auto chains = read("a.dxf", text);
  ASSERT_EQ(chains.size(), 3u);
  EXPECT_EQ(chains[0].name, "wall");
  EXPECT_EQ(chains[2].name, "inlet");
  Warnings warnings;
  const Geometry geometry = assemble(chains, {}, warnings);
  EXPECT_EQ(geometry.size(), 3);
  EXPECT_EQ(geometry.boundaries().size(), 2u);
}

std::string dxf_arc(const std::string& layer, double x, double y, double radius, double from, double to) {
  return fmt::format("  0\nARC\n  8\n{}\n 10\n{}\n 20\n{}\n 40\n{}\n 50\n{}\n 51\n{}\n", layer, x, y, radius,
                     from, to);
}

std::string dxf_of(const std::string& entities) {
  return "  0\nSECTION\n  2\nENTITIES\n" + entities + "  0\nENDSEC\n  0\nEOF\n";
}

/// A drawing with a header, and a layer "old" that is frozen.
std::string drawing_of(const std::string& entities) {
  return "  0\nSECTION\n  2\nHEADER\n  9\n$ACADVER\n  1\nAC1015\n  9\n$INSUNITS\n 70\n4\n  0\nENDSEC\n"
         "  0\nSECTION\n  2\nTABLES\n  0\nTABLE\n  2\nLAYER\n"
         "  0\nLAYER\n  2\nold\n 70\n1\n 62\n7\n  6\nCONTINUOUS\n  0\nENDTAB\n  0\nENDSEC\n" +
         dxf_of(entities);
}

std::string entity(const std::string& type, const std::string& handle, const std::string& pairs) {
  return fmt::format("  0\n{}\n  5\n{}\n{}", type, handle, pairs);
}

std::string dxf_circle(const std::string& handle, const std::string& layer, double radius,
                       const std::string& more = "") {
  return entity("CIRCLE", handle, fmt::format("  8\n{}\n{} 10\n0\n 20\n0\n 40\n{}\n", layer, more, radius));
}

TEST_F(OgrReader, TellsTheUnitThatAFileDeclares) {
  read("a.dxf", drawing_of(dxf_circle("A1", "wall", 4)));
  EXPECT_EQ(unit_.name, "mm");
  EXPECT_EQ(unit_.metres, 1e-3);
  unit_ = {};
  read("b.dxf", dxf_of(dxf_circle("A1", "wall", 4)));
  EXPECT_EQ(unit_.name, "");
  const std::string loop = feature("", "Polygon", "[[[0,0],[9,0],[9,9],[0,0]]]");
  read("degrees.geojson", collection(loop));
  EXPECT_EQ(unit_.name, "");
  std::string projected = collection(loop);
  projected.insert(projected.size() - 1,
                   R"(,"crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::2263"}})");
  read("feet.geojson", projected);
  EXPECT_EQ(unit_.name, "US survey foot");
  EXPECT_NEAR(unit_.metres, 0.3048006, 1e-7);
}

TEST_F(OgrReader, LeavesOutWhatIsNotSeenOrNoOutline) {
  const std::string paper = " 67\n1\n";
  const std::string text = drawing_of(
      dxf_circle("A1", "wall", 4) + dxf_circle("A2", "old", 2) + dxf_circle("A3", "wall", 3, paper) +
      entity("POINT", "A4", "  8\nwall\n 10\n1\n 20\n1\n") +
      entity("TEXT", "A5", "  8\nnotes\n 10\n1\n 20\n1\n 40\n1\n  1\nhello\n") +
      entity("SOLID", "A6", "  8\nnotes\n 10\n0\n 20\n0\n 11\n1\n 21\n0\n 12\n0\n 22\n1\n 13\n0\n 23\n1\n"));
  const auto chains = read("a.dxf", text);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].name, "wall");
  EXPECT_NEAR(length(chains[0].points[0]), 4, 1e-12);
  ASSERT_EQ(warnings_.size(), 1u);
  for (const char* piece : {"1 CIRCLE not visible on layer 'old'", "1 CIRCLE in paper space",
                            "1 POINT on layer 'wall'", "1 TEXT on layer 'notes'", "1 SOLID on layer 'notes'"})
    EXPECT_NE(warnings_[0].find(piece), std::string::npos) << piece << " in " << warnings_[0];
}

TEST_F(OgrReader, ReadsTheLayersThatAreNamed) {
  const std::string text = drawing_of(dxf_circle("A1", "wall", 4) + dxf_circle("A2", "old", 2));
  layers_ = {"o*"};
  const auto chains = read("a.dxf", text);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].name, "old");
  EXPECT_TRUE(warnings_.empty());
  layers_ = {"walls", "in?"};
  const std::string said = test::refusal(folder_, [&] { read("b.dxf", text); });
  EXPECT_NE(said.find("one of [walls, in?]; its layers are: old, wall"), std::string::npos) << said;
}

/// A square of lines without handles, as R12 has them.
std::string dxf_square(const std::string& layer, double x, double side) {
  return dxf_line(layer, x, x, x + side, x) + dxf_line(layer, x + side, x, x + side, x + side) +
         dxf_line(layer, x + side, x + side, x, x + side) + dxf_line(layer, x, x + side, x, x);
}

/// A drawing with layers "wall", "old" (frozen) and "dark" (off), a block "Hole" and the entities.
std::string drawing_with_block(const std::string& content, const std::string& entities) {
  std::string layers;
  for (const auto& [name, frozen, colour] : {std::tuple("wall", 0, 7), {"old", 1, 7}, {"dark", 0, -7}})
    layers += fmt::format("  0\nLAYER\n  2\n{}\n 70\n{}\n 62\n{}\n  6\nCONTINUOUS\n", name, frozen, colour);
  return "  0\nSECTION\n  2\nTABLES\n  0\nTABLE\n  2\nLAYER\n" + layers +
         "  0\nENDTAB\n  0\nENDSEC\n  0\nSECTION\n  2\nBLOCKS\n"
         "  0\nBLOCK\n  8\n0\n  2\nHole\n 70\n0\n 10\n0\n 20\n0\n  3\nHole\n" +
         content + "  0\nENDBLK\n  8\n0\n  0\nENDSEC\n" + dxf_of(entities);
}

std::string with_header(const std::string& drawing) {
  return "  0\nSECTION\n  2\nHEADER\n  9\n$ACADVER\n  1\nAC1015\n  0\nENDSEC\n" + drawing;
}

std::string insert_of(const std::string& block, const std::string& layer, bool with_classes = false) {
  return fmt::format("  0\nINSERT\n{}  8\n{}\n{}  2\n{}\n 10\n3\n 20\n3\n 30\n0\n",
                     with_classes ? "100\nAcDbEntity\n" : "", layer,
                     with_classes ? "100\nAcDbBlockReference\n" : "", block);
}

TEST_F(OgrReader, LayersWithinABlockAreHiddenAsElsewhere) {
  const std::string content = dxf_square("wall", 0, 2) + dxf_square("old", 3, 1) + dxf_square("dark", 5, 1);
  const std::string text = with_header(drawing_with_block(content, insert_of("Hole", "wall")));
  const auto chains = read("a.dxf", text);
  ASSERT_EQ(chains.size(), 4u);
  for (const Chain& chain : chains) {
    EXPECT_EQ(chain.name, "wall");
    EXPECT_LE(chain.points[0].x, 5) << "3 for the place of the block, and 2";
  }
  ASSERT_EQ(warnings_.size(), 1u);
  for (const char* piece : {"4 entity not visible on layer 'old'", "4 entity not visible on layer 'dark'"})
    EXPECT_NE(warnings_[0].find(piece), std::string::npos) << piece << " in " << warnings_[0];
  layers_ = {"old"};
  EXPECT_EQ(read("b.dxf", text).size(), 4u);
}

TEST_F(OgrReader, ReadsBlocksOfDrawingsWithClasses) {
  const auto chains =
      read("a.dxf", with_header(drawing_with_block(dxf_square("0", 0, 2), insert_of("Hole", "wall", true))));
  ASSERT_EQ(chains.size(), 4u);
  EXPECT_EQ(chains[0].name, "wall") << "what is on layer 0 of a block takes the layer of the reference";
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
}

TEST_F(OgrReader, NamesOfADrawingHaveNoCase) {
  const auto chains =
      read("a.dxf", with_header(drawing_with_block(dxf_square("0", 0, 2), insert_of("HOLE", "Wall", true) +
                                                                              dxf_circle("A1", "OLD", 1))));
  ASSERT_EQ(chains.size(), 4u);
  EXPECT_EQ(chains[0].name, "wall");
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("1 CIRCLE not visible on layer 'old'"), std::string::npos) << warnings_[0];
  layers_ = {"OLD"};
  EXPECT_EQ(read("b.dxf", drawing_of(dxf_circle("A1", "old", 1))).size(), 1u);
}

TEST_F(OgrReader, WarnsOfReferencesToMissingBlocks) {
  read("a.dxf", with_header(drawing_with_block("", insert_of("nope", "wall") + dxf_square("wall", 0, 1))));
  ASSERT_EQ(warnings_.size(), 1u);
  EXPECT_NE(warnings_[0].find("1 INSERT of block 'nope', whose content is not in the file"),
            std::string::npos)
      << warnings_[0];
}

TEST_F(OgrReader, ASplineHasAPointAtEachKnot) {
  // Two parabolas that meet in a kink at (2, 0), where the knot has the degree for its multiplicity.
  std::string pairs = "  8\nwall\n 70\n8\n 71\n2\n 72\n8\n 73\n5\n";
  for (const double knot : {0., 0., 0., 1., 1., 3., 3., 3.}) pairs += fmt::format(" 40\n{}\n", knot);
  const std::array<Point, 5> controls{{{0, 0}, {1, 2}, {2, 0}, {3, 2}, {4, 0}}};
  for (const Point p : controls) pairs += fmt::format(" 10\n{}\n 20\n{}\n 30\n0\n", p.x, p.y);
  const auto chains = read("a.dxf", drawing_of(entity("SPLINE", "B1", pairs)));
  ASSERT_EQ(chains.size(), 1u);
  const std::vector<Point>& points = chains[0].points;
  EXPECT_EQ(points.front(), (Point{0, 0}));
  EXPECT_EQ(points.back(), (Point{4, 0}));
  EXPECT_EQ(std::ranges::count(points, Point{2, 0}), 1);
  EXPECT_EQ(std::ranges::count(points, Point{1, 1}), 1);  // halfway of the first parabola
  EXPECT_EQ(std::ranges::count(points, Point{3, 1}), 1);
}

TEST_F(OgrReader, NamesASplineOfFitPointsAndABinaryDrawing) {
  const std::string fit =
      "  8\nrim\n 70\n8\n 71\n3\n 72\n0\n 73\n0\n 74\n2\n 11\n0\n 21\n0\n 11\n1\n 21\n1\n";
  const std::string said =
      test::refusal(folder_, [&] { read("a.dxf", drawing_of(entity("SPLINE", "B7", fit))); });
  EXPECT_NE(said.find("layer 'rim': the spline of handle B7 is given by fit points alone"), std::string::npos)
      << said;
  const std::string binary =
      test::refusal(folder_, [&] { read("b.dxf", std::string("AutoCAD Binary DXF\r\n\x1a\0", 22)); });
  EXPECT_NE(binary.find("binary DXF"), std::string::npos) << binary;
}

TEST_F(OgrReader, ReadsADrawingThatBeginsWithItsBlocks) {
  const std::string blocks = "  0\nSECTION\n  2\nBLOCKS\n  0\nENDSEC\n";
  const auto chains = read("a.dxf", blocks + dxf_of(dxf_line("0", 0, 0, 1, 0) + dxf_line("0", 1, 0, 0, 1)));
  EXPECT_EQ(chains.size(), 2u);
}

TEST_F(OgrReader, ANameComesBeforeABoundary) {
  const auto chains = read("a.geojson", collection(feature(R"("boundary":"administrative","name":"Anholt")",
                                                           "Polygon", "[[[0,0],[900,0],[900,900],[0,0]]]")));
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].name, "Anholt");
}

void expect_joined(const std::vector<Chain>& chains, std::size_t boundaries) {
  Warnings warnings;
  const Geometry geometry = assemble(chains, {}, warnings);
  ASSERT_EQ(geometry.loop_count(), 1);
  EXPECT_EQ(geometry.boundaries().size(), boundaries);
  for (std::int32_t v = 0; v < geometry.size(); ++v)
    EXPECT_GT(length(geometry.point(geometry.next(v)) - geometry.point(v)), 1e-3);
  const bool told = std::any_of(warnings.begin(), warnings.end(), [](const std::string& w) {
    return w.find("no farther apart than") < w.size();
  });
  EXPECT_TRUE(told) << fmt::format("{}", fmt::join(warnings, "; "));
}

TEST_F(OgrReader, JoinsDxfArcsWhoseEndsDifferByRounding) {
  const std::string slot = dxf_line("wall", 0.1, 0.3, 2.1, 0.3) + dxf_arc("end", 2.1, 0.8, 0.5, 270, 90) +
                           dxf_line("wall", 2.1, 1.3, 0.1, 1.3) + dxf_arc("end", 0.1, 0.8, 0.5, 90, 270);
  expect_joined(read("a.dxf", dxf_of(slot)), 2);
  expect_joined(
      read("b.dxf", dxf_of(dxf_arc("a", 0.3, 0.7, 1.1, 10, 200) + dxf_arc("b", 0.3, 0.7, 1.1, 200, 10))), 2);
}

TEST_F(OgrReader, ClosesADxfPolylineOfArcs) {  // bulges of 1: half circles
  const std::string slot =
      "  0\nLWPOLYLINE\n  8\nslot\n 90\n4\n 70\n1\n 10\n0.1\n 20\n0.3\n 10\n2.1\n 20\n0.3\n 42\n1\n "
      "10\n2.1\n 20\n1.3\n 10\n0.1\n 20\n1.3\n 42\n1\n";
  expect_joined(read("a.dxf", dxf_of(slot)), 1);
}

TEST_F(OgrReader, RefusesWhatItCannotRead) {
  EXPECT_EQ(
      test::refusal(folder_, [&] { read("a.geojson", "{ nonsense"); }).find("a.geojson: cannot be read"), 0u);
  EXPECT_EQ(
      test::refusal(folder_, [&] { read("a.geojson", collection("")); }).find("a.geojson: holds no lines"),
      0u);
  EXPECT_EQ(test::refusal(folder_, [&] { read("a.shp", "x"); }).find("a.shp: cannot be read"), 0u);
  EXPECT_EQ(test::refusal(folder_, [&] { read("a.gpkg", ""); }).find("a.gpkg: cannot be read"), 0u);
}

TEST_F(OgrReader, ReadsTheGulfAsItsGeomTwin) {
  const std::string stem = QUADLOOP_SOURCE_DIR "/../shared/data/gulf_of_mexico_coarse";
  if (!std::filesystem::exists(stem + ".geojson")) GTEST_SKIP() << "the data folder is not here";
  const auto twin = read_geometry(stem + ".geom", warnings_),
             chains = read_geometry(stem + ".geojson", warnings_);
  ASSERT_EQ(chains.size(), twin.size());
  for (std::size_t i = 0; i < chains.size(); ++i) {
    EXPECT_EQ(chains[i].name, twin[i].name);
    EXPECT_EQ(chains[i].open, twin[i].open);
    EXPECT_EQ(chains[i].points.size(), twin[i].points.size());
  }
}

}  // namespace
}  // namespace quadloop::io
