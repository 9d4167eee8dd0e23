#include "io/gis/ogr_reader.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "io/gis/gis_formats.hpp"
#include "io/input/geometry_file.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop::io {
namespace {

class OgrReader : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { add_gis_formats(); }
  std::vector<Chain> read(const std::string& name, const std::string& text) {
    return read_ogr(folder_.write(name, text), choice_, warnings_, unit_);
  }

  test::InputFolder folder_;
  DrawingChoice choice_;
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

TEST_F(OgrReader, TellsTheUnitThatAFileDeclares) {
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

TEST_F(OgrReader, ANameComesBeforeABoundary) {
  const auto chains = read("a.geojson", collection(feature(R"("boundary":"administrative","name":"Anholt")",
                                                           "Polygon", "[[[0,0],[900,0],[900,900],[0,0]]]")));
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].name, "Anholt");
}

TEST_F(OgrReader, NamesBoundariesByLayerAttributeOrFile) {
  const std::string text = collection(
      feature(R"("name":"Anholt","kind":"sea wall")", "Polygon", "[[[0,0],[900,0],[900,900],[0,0]]]") + "," +
      feature(R"("name":"Laesoe")", "Polygon", "[[[2000,0],[2900,0],[2900,900],[2000,0]]]"));
  using From = BoundaryNames::From;
  const auto names = [&](From from, const std::string& attribute) {
    choice_.names = {from, attribute};
    const auto chains = read("isles.geojson", text);
    return chains.at(0).name + " " + chains.at(1).name;
  };
  EXPECT_EQ(names(From::usual, ""), "Anholt Laesoe");
  EXPECT_EQ(names(From::layer, ""), "isles isles");
  EXPECT_EQ(names(From::block, ""), "isles isles") << "a map has none";
  EXPECT_EQ(names(From::file, ""), "isles isles");
  EXPECT_EQ(names(From::attribute, "KIND"), "sea_wall isles") << "the second has none";
  choice_.layers = {"other"};
  EXPECT_NE(test::refusal(folder_, [&] { read("isles.geojson", text); }).find("its layers are: isles"),
            std::string::npos);
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
