// The table [geometry]: files, units, layers of drawings, far fields, and its refusals.
#include <gtest/gtest.h>

#include <algorithm>

#include "io/gis/gis_formats.hpp"
#include "mesher/base/error.hpp"
#include "tests/quadloop/case/settings_fixture.hpp"

namespace quadloop {
namespace {

class GeometrySettings : public test::SettingsFixture {};

TEST_F(GeometrySettings, CoordinatesInAUnitBecomeMetres) {
  EXPECT_EQ(load(read("")).point(2), (Point{4, 4})) << "as they stand";
  EXPECT_EQ(load(read("unit = \"none\"\n")).point(2), (Point{4, 4}));
  EXPECT_EQ(load(read("unit = \"km\"\n")).point(2), (Point{4000, 4000}));
  EXPECT_EQ(load(read("unit = \"inch\"\nscale = 2\n")).point(2), (Point{8 * 0.0254, 8 * 0.0254}));
  EXPECT_NE(refused("unit = \"ell\"\n").find("'geometry.unit' is 'ell', but must be"), std::string::npos)
      << refused("unit = \"ell\"\n");
  EXPECT_NE(refused("unit = \"file\"\n").find("declares no unit of length; name its unit"),
            std::string::npos);
  Warnings warnings;
  std::vector<FileExtent> extents;
  load_geometry(read("unit = \"mm\"\ntranslate = [7, 0]\n"), warnings, {}, &extents);
  ASSERT_EQ(extents.size(), 1u);
  EXPECT_EQ(extents[0].box.high, (Point{4, 4})) << "as they stand in the file";
  EXPECT_EQ(extents[0].metres, 1e-3);
}

TEST_F(GeometrySettings, WarnsOfSizesThatAreNotInMetres) {
  const auto warning = [&](const std::string& text) {
    const Settings settings = read(text);
    Warnings warnings;
    std::vector<FileExtent> extents;
    const Geometry geometry = load_geometry(settings, warnings, {}, &extents);
    return unit_warning(extents, mesh_options(settings, geometry), geometry).value_or("none");
  };
  EXPECT_EQ(warning("unit = \"mm\"\n[spacing]\nmax = 0.5\n"),
            "spacing.max = 0.5 is larger than the whole domain, whose longer side is 0.004: geometry.unit "
            "converts the coordinates to metres; give all lengths of the case in metres");
  EXPECT_EQ(warning("unit = \"mm\"\n[spacing]\nmax = 0.001\n[boundary.box]\nspacing = 1\n")
                .find("the spacing of boundary 'box' = 1 is larger"),
            0u);
  EXPECT_EQ(warning("unit = \"mm\"\n[spacing]\nmax = 0.004\n[boundary.box]\nspacing = 0.001\n"), "none");
  EXPECT_EQ(warning("[spacing]\nmax = 8\n"), "none") << "no conversion";
}

TEST_F(GeometrySettings, EachEntryOfLayersMatchesALayer) {
  folder_.write("map.geojson",
                R"({"type":"FeatureCollection","name":"shore","features":[{"type":"Feature","properties":{},)"
                R"("geometry":{"type":"Polygon","coordinates":[[[0,0],[900,0],[900,900],[0,0]]]}}]})");
  io::add_gis_formats();
  const auto load_layers = [&](const std::string& layers) {
    const std::string text = "[geometry]\nfile = \"map.geojson\"\nlayers = " + layers + "\n";
    return load(read_settings(folder_.write("map.toml", text), {}));
  };
  const std::string said = test::refusal(folder_, [&] { load_layers(R"(["sh*", "shor"])"); });
  EXPECT_NE(
      said.find("geometry.layers: no layer matches 'shor'; the layers are: shore; do you mean 'shore'?"),
      std::string::npos)
      << said;
  EXPECT_EQ(load_layers(R"(["SHORE"])").boundaries().size(), 1u);
}

TEST_F(GeometrySettings, NamesTheBoundariesOfADrawing) {
  folder_.write("ring.dxf", "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\nwall\n62\n1\n40\n1\n0\nENDSEC\n0\nEOF\n");
  const auto name_by = [&](const std::string& names) {
    const std::string text = "[geometry]\nfile = \"ring.dxf\"\nnames = \"" + names + "\"\n";
    return load(read_settings(folder_.write("ring.toml", text), {})).boundary(BoundaryId{0}).name;
  };
  EXPECT_EQ(name_by("layer"), "wall");
  EXPECT_EQ(name_by("colour"), "red");
  EXPECT_EQ(name_by("file"), "ring");
  EXPECT_EQ(name_by("attribute:id"), "wall");
  EXPECT_NE(test::refusal(folder_, [&] { name_by("color"); }).find("do you mean 'colour'?"),
            std::string::npos);
  EXPECT_THROW(name_by("attribute:"), InputError);
  EXPECT_NE(refused("names = \"layer\"\n").find("no file is one"), std::string::npos);
}

TEST_F(GeometrySettings, AFarFieldRoundAnOuterBoundaryIsRefused) {
  folder_.write("box.geom", "2\nbox\n4\n-4 -4\n6 -4\n6 4\n-4 4\nwedge\n3\n0 0\n1 0.2\n1 -0.2\n");
  const std::string fault = refused("far_field = 20\n");
  EXPECT_EQ(
      fault.find("case.toml:3: 'geometry.far_field': boundary 'box' already encloses a domain, with boundary "
                 "'wedge' at (0, 0) in it; remove far_field"),
      0u)
      << fault;
  EXPECT_EQ(load(read("")).loop_count(), 2);
}

TEST_F(GeometrySettings, AnAirfoilWithoutAnOuterBoundaryIsRefused) {
  folder_.write("wing.dat", "wing\n1 0\n0.5 0.06\n0 0\n0.5 -0.06\n1 0\n");
  const auto settings = [&](const std::string& keys) {
    return read_settings(folder_.write("wing.toml", "[geometry]\nfile = \"wing.dat\"\n" + keys), {});
  };
  const std::string fault = test::refusal(folder_, [&] { load(settings("")); });
  EXPECT_NE(
      fault.find(
          "has no outer boundary around it; set geometry.far_field to add one, or geometry.inside = true"),
      std::string::npos)
      << fault;
  EXPECT_EQ(load(settings("inside = true\n")).loop_count(), 1);
  EXPECT_EQ(load(settings("inside = false\nfar_field = 10\n")).loop_count(), 2);
  EXPECT_NE(test::refusal(folder_, [&] { load(settings("inside = 1\n")); })
                .find("'geometry.inside' must be true or false"),
            std::string::npos);
}

TEST_F(GeometrySettings, AFarFieldMayBeATable) {
  const auto far_field = [&](const std::string& keys) { return "far_field = { " + keys + " }\n"; };
  const Settings settings = read(far_field("shape = \"circle\", radius = 20, spacing = 3"));
  EXPECT_EQ(settings.far_field->shape, FarFieldShape::circle);
  const Geometry circle = load(settings);
  EXPECT_EQ(circle.boundary(BoundaryId{1}).spacing, 3);
  EXPECT_EQ(circle.boundary(BoundaryId{1}).condition, BoundaryCondition::farfield);
  EXPECT_EQ(circle.box().high, (Point{22, 22}));
  EXPECT_EQ(load(read(far_field("radius = 20"))).box().low, (Point{-18, -18})) << "a square";
  const Settings both = read(far_field("radius = 20, spacing = 3") + "[boundary.farfield]\nspacing = 2\n");
  EXPECT_EQ(load(both).boundary(BoundaryId{1}).spacing, 2);
  EXPECT_NE(refused(far_field("shape = \"circle\"")).find("'geometry.far_field.radius' is missing"),
            std::string::npos);
  EXPECT_NE(refused(far_field("shape = \"oval\", radius = 9")).find("'geometry.far_field.shape' is 'oval'"),
            std::string::npos);
  EXPECT_NE(refused(far_field("shape = \"circle\", radius = 2")).find("case.toml:3: 'geometry.far_field'"),
            std::string::npos);
}

TEST_F(GeometrySettings, EachFileHasItsOwnPlace) {
  folder_.write("two.geom", "1\ntwo\n4\n0 0\n4 0\n4 4\n0 4\n");
  const std::string path = folder_.write("two.toml",
                                         "[geometry]\nfile = [\"box.geom\", \"two.geom\"]\ntranslate = [[0, "
                                         "0], [10, 0]]\nscale = [1, 0.5]\nrotate = 90\n");
  const Geometry g = load(read_settings(path, {}));
  EXPECT_EQ(g.loop_count(), 2);
  EXPECT_EQ(g.point(g.loop_start(1)), (Point{10, 0}));
  EXPECT_EQ(g.box().high, (Point{10, 4}));
  EXPECT_NE(test::refusal(folder_, [&] { read_settings(path, {"geometry.scale=[1,2,3]"}); }).find("2 files"),
            std::string::npos);
}

TEST_F(GeometrySettings, AFileTurnsAboutItsHinge) {
  folder_.write("flap.geom", "1\nflap\n3\n1.5 1\n2 1\n1.5 1.5\n");
  const auto flap = [&](const std::string& keys) {
    const std::string path =
        folder_.write("flap.toml", "[geometry]\nfile = [\"box.geom\", \"flap.geom\"]\n" + keys);
    const Geometry g = load(read_settings(path, {}));
    return std::vector<Point>(g.points().end() - 3, g.points().end());
  };
  const auto has = [](const std::vector<Point>& points, Point p) {
    return std::ranges::count(points, p) == 1;
  };
  EXPECT_TRUE(has(flap("rotate = [0, 90]\nrotate_about = [1.5, 1]\n"), {1.5, 1.5}));
  EXPECT_TRUE(has(flap("rotate = [0, 90]\nrotate_about = [[7, 7], [1.5, 1]]\n"), {1, 1}));
  EXPECT_TRUE(has(flap("scale = [1, 0.5]\nrotate = [0, 180]\nrotate_about = [1, 1]\n"), {1.25, 1.5}));
  EXPECT_NE(test::refusal(folder_, [&] { flap("rotate_about = [1, 1]\n"); }).find("needs rotate"),
            std::string::npos);
}

TEST_F(GeometrySettings, NamesTheKeyOfAMissingGeometry) {
  const std::string path =
      folder_.write("lost.toml", "title = \"x\"\n[geometry]\nfile = [\"box.geom\", \"none.geom\"]\n");
  const std::string said = test::refusal(folder_, [&] { load(read_settings(path, {})); });
  EXPECT_EQ(said.find("lost.toml:3: 'geometry.file': there is no file '"), 0u) << said;
  EXPECT_NE(said.find("none.geom"), std::string::npos) << said;
}

TEST_F(GeometrySettings, NeedsAGeometry) {
  const std::string path = folder_.write("none.toml", "title = \"x\"\n");
  EXPECT_EQ(test::refusal(folder_, [&] { read_settings(path, {}); }).find("none.toml"), 0u);
}

}  // namespace
}  // namespace quadloop
