#include "quadloop/case/settings.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "generate/digests.hpp"
#include "io/gis/gis_formats.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop {
namespace {

using flow::EulerOptions;

class SettingsTest : public ::testing::Test {
 protected:
  SettingsTest() { folder_.write("box.geom", "1\nbox\n4\n0 0\n4 0\n4 4\n0 4\n"); }

  Settings read(const std::string& text, const std::vector<std::string>& assignments = {}) {
    return read_settings(folder_.write("case.toml", "[geometry]\nfile = \"box.geom\"\n" + text), assignments);
  }
  Geometry load(const Settings& settings) {
    Warnings warnings;
    return load_geometry(settings, warnings);
  }
  /// The refusal of case text that follows two lines of [geometry].
  std::string refused(const std::string& text) {
    return test::refusal(folder_, [&] { load(read(text)); });
  }

  test::InputFolder folder_;
};

TEST_F(SettingsTest, AWallMayBeViscousOrInviscid) {
  for (const std::string wall : {"viscous", "inviscid"}) {
    const Geometry geometry =
        load(read("[spacing]\nmin = 0.5\nmax = 1\n[boundary.box]\nbc = \"wall\"\nwall = \"" + wall + "\"\n"));
    EXPECT_EQ(geometry.boundaries()[0].condition.word(), wall + "_wall");
  }
}

TEST_F(SettingsTest, CoordinatesInAUnitBecomeMetres) {
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

TEST_F(SettingsTest, EachEntryOfLayersMatchesALayer) {
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

TEST_F(SettingsTest, NamesTheBoundariesOfADrawing) {
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

TEST_F(SettingsTest, ReadsEveryKey) {
  const Settings s = read(R"(far_field = 10
scale = 2
rotate = 90
translate = [1, 2]
[spacing]
min = 0.5
max = 1
gradation = 1.25
curvature = 10
gap = 2
corner = 20
[boundary.box]
spacing = 0.25
corner = 180
bc = "wall"
[[source]]
box = [0, 1, 2, 3]
spacing = 0.1
[[source]]
disc = [0, 1, 2]
spacing = 0.2
[[source]]
line = [0, 1, 2, 3]
spacing = 0.3
[mesh]
type = "hybrid"
root = [-10, -10, 20, 1, 1]
snap = 0.001
[output]
prefix = "out"
formats = ["cgns"]
)");
  EXPECT_EQ(s.files[0].transform.scale, 2);
  EXPECT_EQ(s.files[0].transform.rotate_degrees, 90);
  EXPECT_EQ(s.files[0].transform.translate, (Point{1, 2}));
  EXPECT_EQ(s.far_field->radius, 10);
  EXPECT_EQ(s.mesh.size.gradation, 1.25);
  EXPECT_EQ(s.mesh.size.curvature, 10);
  EXPECT_EQ(s.mesh.size.gap, 2);
  ASSERT_EQ(s.mesh.size.sources.size(), 3u);
  EXPECT_EQ(std::get<Box>(s.mesh.size.sources[0].shape).high, (Point{1, 3}));
  EXPECT_EQ(std::get<SizeSource::Disc>(s.mesh.size.sources[1].shape).radius, 2);
  EXPECT_EQ(std::get<SizeSource::Line>(s.mesh.size.sources[2].shape).to, (Point{2, 3}));
  EXPECT_EQ(s.mesh.size.root->tree_edge, 20);
  EXPECT_EQ(s.mesh.snap, 0.001);
  EXPECT_EQ(s.output_prefix, "out");
  EXPECT_EQ(s.formats, std::vector<std::string>{"cgns"});
  const Geometry g = load(s);
  EXPECT_EQ(g.boundary(BoundaryId{0}).spacing, 0.25);
  EXPECT_EQ(g.boundary(BoundaryId{0}).condition, BoundaryCondition::wall);
  EXPECT_EQ(g.boundary(BoundaryId{1}).name, "farfield");
  EXPECT_EQ(g.boundary(BoundaryId{1}).condition, BoundaryCondition::farfield);
  EXPECT_EQ(g.boundary(BoundaryId{1}).corner_degrees, 20);
}

TEST_F(SettingsTest, AFarFieldRoundAnOuterBoundaryIsRefused) {
  folder_.write("box.geom", "2\nbox\n4\n-4 -4\n6 -4\n6 4\n-4 4\nwedge\n3\n0 0\n1 0.2\n1 -0.2\n");
  const std::string fault = refused("far_field = 20\n");
  EXPECT_EQ(
      fault.find("case.toml:3: 'geometry.far_field': boundary 'box' already encloses a domain, with boundary "
                 "'wedge' at (0, 0) in it; remove far_field"),
      0u)
      << fault;
  EXPECT_EQ(load(read("")).loop_count(), 2);
}

TEST_F(SettingsTest, AnAirfoilWithoutAnOuterBoundaryIsRefused) {
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

TEST_F(SettingsTest, SizesFollowTheGeometryWhereTheyAreNotGiven) {
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

TEST_F(SettingsTest, TheRootMeetsTheSmallestRequestOfABoundaryElseMax) {
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

TEST_F(SettingsTest, TheDefaultOfMinPermitsCellsOfMax) {
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

TEST_F(SettingsTest, AFarFieldMayBeATable) {
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

TEST_F(SettingsTest, SizesAreSmallEnoughForLayersAndLines) {
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

TEST_F(SettingsTest, EachFileHasItsOwnPlace) {
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

TEST_F(SettingsTest, AFileTurnsAboutItsHinge) {
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

TEST_F(SettingsTest, ReadsLayers) {
  const auto layers = [&](const std::string& text) {
    const Geometry g = load(read("[boundary.box]\nlayers = { " + text + " }\n"));
    return g.boundary(BoundaryId{0}).layers.value_or(LayerSpec{});
  };
  EXPECT_FALSE(load(read("")).boundary(BoundaryId{0}).layers.has_value());
  EXPECT_EQ(layers("first = 1e-3, growth = 1.3, count = 12"), (LayerSpec{1e-3, 1.3, 1.3, 12, 1}));
  EXPECT_EQ(layers("first = 1e-3, count = 12"), (LayerSpec{1e-3, 1.2, 1.2, 12, 1}));
  EXPECT_EQ(layers("first = 1e-3, growth = [1.1, 1.5], count = 12, equal = 2"),
            (LayerSpec{1e-3, 1.1, 1.5, 12, 2}));
  EXPECT_EQ(layers("first = 4e-3, growth = 1.5, thickness = 0.019").count, 3) << "4 + 6 + 9";
  EXPECT_EQ(layers("first = 4e-3, growth = 1.5, thickness = 0.0191").count, 4);
}

TEST_F(SettingsTest, RefusesBadLayers) {
  const auto layers = [&](const std::string& text) {
    return refused("[boundary.box]\nlayers = { " + text + " }\n");
  };
  const std::string place = "case.toml:4: 'boundary.box.layers.";
  EXPECT_EQ(layers("count = 3").find(place + "first' is missing"), 0u);
  EXPECT_EQ(layers("first = 0, count = 3").find(place + "first' is 0"), 0u);
  EXPECT_EQ(layers("first = 1").find(place + "count' is missing"), 0u);
  EXPECT_EQ(layers("first = 1, count = 3, thickness = 4").find(place + "thickness' stands beside count"), 0u);
  EXPECT_EQ(layers("first = 1, count = 0").find(place + "count' is 0"), 0u);
  EXPECT_EQ(layers("first = 1, count = 1001").find(place + "count' is 1001"), 0u);
  EXPECT_EQ(layers("first = 1, count = 2.5").find(place + "count' must be a whole number"), 0u);
  EXPECT_EQ(layers("first = 1, growth = 0.9, count = 3").find(place + "growth' "), 0u);
  EXPECT_EQ(layers("first = 1, growth = 2.1, count = 3").find(place + "growth' "), 0u);
  EXPECT_EQ(layers("first = 1, growth = [1.5, 1.2], count = 3").find(place + "growth' must be a number"), 0u);
  EXPECT_EQ(layers("first = 1, growth = [1.1, 1.1, 1.1], count = 3").find(place + "growth' must be a number"),
            0u);
  EXPECT_EQ(
      layers("first = 1, growth = 1.0001, thickness = 1100").find(place + "thickness' takes more than 1000"),
      0u);
  EXPECT_EQ(layers("first = 1, equal = 0, count = 3").find(place + "equal' is 0"), 0u);
  EXPECT_EQ(layers("first = 1, count = 3, height = 1")
                .find("case.toml:4: unknown key 'boundary.box.layers.height'"),
            0u);
}

TEST_F(SettingsTest, AMisspeltKeyThatIsNeededIsUnknownAndNotMissing) {
  EXPECT_EQ(refused("[boundary.box]\nlayers = { frist = 1, count = 3 }\n"),
            "case.toml:4: unknown key 'boundary.box.layers.frist'; known here: first, growth, count, "
            "thickness, equal; do you mean 'first'?");
  EXPECT_EQ(refused("[boundary.box]\nlayers = { first = 1, cuont = 3 }\n"),
            "case.toml:4: unknown key 'boundary.box.layers.cuont'; known here: first, growth, count, "
            "thickness, equal; do you mean 'count'?");
  EXPECT_EQ(refused("[[wake]]\nfrom = \"box\"\nlenght = 3\nspacing = 1\n"),
            "case.toml:5: unknown key 'wake.0.lenght'; known here: from, at, length, path, spacing; do you "
            "mean 'length'?");
  EXPECT_EQ(refused("[[wake]]\nfrm = \"box\"\n"),
            "case.toml:4: unknown key 'wake.0.frm'; known here: from, at, length, path, spacing; do you mean "
            "'from'?");
}

TEST_F(SettingsTest, ReadsWakesAndFreeLinesWithLayers) {
  EXPECT_TRUE(read("").lines.empty());
  const Settings settings = read(
      "[[wake]]\nfrom = \"box\"\nlength = 3\nspacing = 0.1\n"
      "[[wake]]\nfrom = \"box\"\nat = [1, 0]\npath = [[2, 0], [4, 1]]\nspacing = 0.2\n"
      "[[layer_line]]\npath = [[0, 0], [1, 1]]\nspacing = 0.3\nfirst = 1e-3\ncount = 5\n");
  ASSERT_EQ(settings.lines.size(), 3U);
  EXPECT_TRUE(settings.lines[0].where.ends_with("/case.toml:3")) << settings.lines[0].where;
  EXPECT_TRUE(settings.lines[2].where.ends_with("/case.toml:12")) << settings.lines[2].where;
  const auto both = read("[[wake]]\nfrom = [\"upper\", \"lower\"]\nlength = 1\nspacing = 1\n").lines;
  EXPECT_EQ(both[0].from, (std::vector<std::string>{"upper", "lower"}));
  EXPECT_EQ(settings.lines[0], (LayerLine{{"box"}, {}, 3, 0.1, {}}));
  EXPECT_EQ(settings.lines[1], (LayerLine{{"box"}, {{2, 0}, {4, 1}}, 0, 0.2, {}, {}, Point{1, 0}}));
  EXPECT_EQ(settings.lines[2], (LayerLine{{}, {{0, 0}, {1, 1}}, 0, 0.3, LayerSpec{1e-3, 1.2, 1.2, 5, 1}}));
}

TEST_F(SettingsTest, RefusesBadWakesAndFreeLines) {
  const auto wake = [&](const std::string& text) { return refused("[[wake]]\n" + text + "\n"); };
  const auto line = [&](const std::string& text) { return refused("[[layer_line]]\n" + text + "\n"); };
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(wake("length = 1\nspacing = 1"), "from' is missing");
  has(wake("from = \"a\"\nspacing = 1"), "length' is missing: how far the wake goes on, or with path where");
  has(wake("from = \"a\"\nlength = 1\npath = [[1, 1]]\nspacing = 1"), "length' stands beside path");
  has(wake("from = \"a\"\nat = [1]\nlength = 1\nspacing = 1"), "at' ");
  has(wake("from = \"a\"\nlength = 1"), "spacing' is missing");
  has(wake("from = \"a\"\nlength = 1\nspacing = 0"), "spacing' is 0");
  has(wake("from = \"a\"\npath = [[1, 1], [1, 1]]\nspacing = 1"),
      "path' has the point (1, 1) twice in a row");
  has(wake("from = \"a\"\nlength = 1\nspacing = 1\nfirst = 1"), "unknown key");
  has(line("path = [[1, 1]]\nspacing = 1\nfirst = 1\ncount = 1"), "path' must have two points at least");
  has(line("path = [[1, 1], [2, 2]]\nspacing = 1\ncount = 1"), "first' is missing");
}

TEST_F(SettingsTest, ReadsWhatFlowsInTimeAreToDo) {
  const EulerOptions usual = read("[solver]\nmach = 1\n").solver.euler;
  EXPECT_EQ(usual.unsteady, EulerOptions::Unsteady::stop);
  EXPECT_FALSE(usual.time_step || usual.average_from);
  const EulerOptions transferred =
      read("[solver]\nunsteady = \"carry_on\"\nflow_throughs = 7\ntime_step = 0.5\n").solver.euler;
  EXPECT_EQ(transferred.unsteady, EulerOptions::Unsteady::continue_in_time);
  EXPECT_EQ(transferred.flow_throughs, 7);
  EXPECT_EQ(transferred.time_step, 0.5);
  const EulerOptions timed =
      read("[solver]\ntime = \"accurate\"\nend_time = 9\naverage_from = 4\n").solver.euler;
  EXPECT_EQ(timed.average_from, 4);
  EXPECT_FALSE(timed.time_step);
}

TEST_F(SettingsTest, ReadsBlocksAndRefusesWhatTheyDoNotGoWith) {
  const std::string gas = "[[block]]\nname = \"gas\"\nboundaries = [\"box\", \"-hole\"]\n";
  const Settings settings = read(gas + "[[block]]\nname = \"solid\"\ninside = [1, 2]\n");
  ASSERT_EQ(settings.outline.blocks.size(), 2U);
  EXPECT_EQ(settings.outline.blocks[0].boundaries, (std::vector<std::string>{"box", "hole"}));
  EXPECT_EQ(settings.outline.blocks[1].inside, (Point{1, 2}));
  EXPECT_EQ(refused("[[block]]\nname = \"gas\"\n").find("case.toml:3: a [[block]] needs exactly one"), 0u);
  EXPECT_EQ(refused(gas + "loop = \"box\"\n").find("case.toml:3: a [[block]] needs exactly one"), 0u);
  EXPECT_EQ(refused("[[block]]\nloop = \"box\"\n").find("case.toml:3: 'block.0.name' is missing"), 0u);
  EXPECT_EQ(refused("[[block]]\nname = \"a b\"\nloop = \"box\"\n").find("case.toml:4: 'block.0.name'"), 0u);
  const std::string start = "case.toml:3: a mesh of several blocks cannot have ";
  for (const auto& [more, what] : {std::pair{"[mesh]\nmirror = \"x\"\n", "mirror images"},
                                   {"[adapt]\nvariable = \"density\"\n", "the built-in solver"},
                                   {"[output]\npartitions = 2\n", "partitions"}})
    EXPECT_EQ(refused(gas + more).find(start + what), 0u) << refused(gas + more);
}

TEST_F(SettingsTest, LayersAreInABlockBesideTheirBoundary) {
  const std::string layers = "[boundary.box]\nlayers = { first = 0.01, count = 2 }\nlayers_in = \"gsa\"\n";
  EXPECT_NE(refused(layers).find("the case has no [[block]]; remove this key"), std::string::npos);
  const std::string block = "[[block]]\nname = \"gas\"\nloop = \"box\"\n";
  const std::string said = refused(block + layers);
  EXPECT_NE(said.find("[boundary.box]: layers_in = \"gsa\": no block of this name is beside boundary 'box'; "
                      "name gas"),
            std::string::npos)
      << said;
}

TEST_F(SettingsTest, RefusesEveryBadKey) {
  EXPECT_EQ(refused("[spacing]\nfoo = 1\n").find("case.toml:4: unknown key 'spacing.foo'"), 0u);
  EXPECT_EQ(refused("[spacings]\n").find("case.toml:3: unknown key 'spacings'"), 0u);
  EXPECT_EQ(refused("[solver]\nmachs = 1\n").find("case.toml:4: unknown key 'solver.machs'"), 0u);
  EXPECT_EQ(
      refused("[solver]\niterations = 1.5\n").find("case.toml:4: 'solver.iterations' must be a whole number"),
      0u);
  EXPECT_EQ(refused("[solver]\nfar_field = \"swirl\"\n").find("case.toml:4: 'solver.far_field'"), 0u);
  EXPECT_EQ(refused("[solver]\ntime = \"accurate\"\n").find("case.toml:3: 'solver.end_time' is missing"), 0u);
  EXPECT_EQ(refused("[solver]\nkind = \"command\"\n").find("case.toml:3: 'solver.command' is missing"), 0u);
  EXPECT_EQ(refused("[boundary.box]\nbc = \"wall\"\npressure = 1\n")
                .find("case.toml:5: 'boundary.box.pressure' needs bc"),
            0u);
  EXPECT_EQ(refused("[boundary.box]\nbc = \"symmetry\"\nwall_temperature = 1\n")
                .find("case.toml:5: 'boundary.box.wall_temperature' needs bc"),
            0u);
  EXPECT_EQ(refused("[solver]\nviscosity = 1\nreynolds = 5\n").find("case.toml:5: 'solver.reynolds' stands"),
            0u);
  EXPECT_EQ(
      refused("[solver]\nmach = 0\nreynolds = 5\n").find("case.toml:5: 'solver.reynolds' needs mach > 0"),
      0u);
  EXPECT_EQ(refused("[output]\npartitions = -1\n").find("case.toml:4: 'output.partitions' is -1"), 0u);
  EXPECT_EQ(refused("[output]\npartitions = 1.5\n").find("case.toml:4: 'output.partitions' must be a whole"),
            0u);
  EXPECT_EQ(refused("[output]\nformats = [\"su2\"]\npartitions = 2\n")
                .find("case.toml:5: 'output.partitions' needs a format"),
            0u);
  EXPECT_EQ(refused("[spacing]\nmin = 0\n").find("case.toml:4: 'spacing.min' is 0"), 0u);
  EXPECT_EQ(refused("[spacing]\nmin = 2\nmax = 1\n")
                .find("case.toml:4: 'spacing.min' is 2, but must not be above spacing.max"),
            0u);
  EXPECT_EQ(refused("[spacing]\ngradation = 1\n").find("case.toml:4: 'spacing.gradation' is 1"), 0u);
  EXPECT_EQ(refused("[spacing]\ncorner = 190\n").find("case.toml:4: 'spacing.corner' is 190"), 0u);
  EXPECT_EQ(refused("[mesh]\nsnap = 0.5\n").find("case.toml:4: 'mesh.snap' is 0.5"), 0u);
  EXPECT_EQ(refused("[mesh]\ntype = \"voronoi\"\n").find("case.toml:4: 'mesh.type' "), 0u);
  EXPECT_EQ(refused("[mesh]\nroot = [0, 0, 1, 1.5, 1]\n").find("case.toml:4: 'mesh.root' must be"), 0u);
  EXPECT_EQ(refused("[boundary.box]\nwall = \"viscous\"\n").find("case.toml:4: 'boundary.box.wall' needs bc"),
            0u);
  EXPECT_EQ(refused("[boundary.box]\nbc = \"wall\"\nwall = \"wet\"\n")
                .find("case.toml:5: 'boundary.box.wall' is 'wet'"),
            0u);
  EXPECT_EQ(refused("[boundary.box]\nbc = \"viscous_wall\"\n").find("case.toml:4: 'boundary.box.bc' is"), 0u);
  EXPECT_EQ(refused("[boundary.hull]\nbc = \"wall\"\n")
                .find("case.toml:3: [boundary.hull]: no boundary of the geometry matches 'hull'"),
            0u);
  EXPECT_EQ(refused("[boundary.box]\nbc = \"wal\"\n").find("case.toml:4: 'boundary.box.bc' is 'wal'"), 0u);
  EXPECT_EQ(refused("[output]\nformats = [\"b8.ugrid\"]\n")
                .find("case.toml:4: 'output.formats' is 'b8.ugrid', but must be one of"),
            0u);
  EXPECT_EQ(refused("[[source]]\nspacing = 1\n").find("case.toml:3: a [[source]] needs exactly one"), 0u);
  EXPECT_EQ(refused("[[source]]\ndisc = [0, 0, 1]\n").find("case.toml:3: 'source.0.spacing' is missing"), 0u);
  EXPECT_EQ(refused("far_field = 1\n").find("case.toml:3: 'geometry.far_field': a far field of half width 1"),
            0u);
}

TEST_F(SettingsTest, NamesTheKeyOfAMissingGeometry) {
  const std::string path =
      folder_.write("lost.toml", "title = \"x\"\n[geometry]\nfile = [\"box.geom\", \"none.geom\"]\n");
  const std::string said = test::refusal(folder_, [&] { load(read_settings(path, {})); });
  EXPECT_EQ(said.find("lost.toml:3: 'geometry.file': there is no file '"), 0u) << said;
  EXPECT_NE(said.find("none.geom"), std::string::npos) << said;
}

TEST_F(SettingsTest, RefusesAPrefixWithASuffix) {
  EXPECT_EQ(refused("[output]\nprefix = \"a.mesh\"\n")
                .find("case.toml:4: 'output.prefix' is 'a.mesh'; give it without .mesh"),
            0u);
  EXPECT_EQ(read("[output]\nprefix = \"out/v1.2\"\n").output_prefix, "out/v1.2");
  EXPECT_EQ(format_suffix_of("a.tree.h5"), ".h5");
  EXPECT_EQ(format_suffix_of("a.mesh/b"), "");
}

TEST_F(SettingsTest, WarnsOfSourcesThatDoNothing) {
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

TEST_F(SettingsTest, ReadsTheSolver) {
  const Settings s = read(R"([solver]
kind = "command"
mach = 0.5
alpha = 2
gamma = 1.3
time = "accurate"
end_time = 3
cfl = 5
iterations = 7
tolerance = 1e-4
limiter = "none"
initial = "vortex"
far_field = "vortex"
reference_length = 2
ranks = 3
command = ["flow", "{mesh}"]
mesh = "m.mesh"
solution = "s.cgns"
timeout = 60
)");
  const EulerOptions& euler = s.solver.euler;
  EXPECT_EQ(euler.mach, 0.5);
  EXPECT_EQ(euler.alpha, 2);
  EXPECT_EQ(euler.gamma, 1.3);
  EXPECT_EQ(euler.far_field, EulerOptions::FarField::vortex);
  EXPECT_EQ(euler.time, EulerOptions::Time::accurate);
  EXPECT_EQ(euler.end_time, 3);
  EXPECT_EQ(euler.cfl, 5);
  EXPECT_EQ(euler.iterations, 7);
  EXPECT_EQ(euler.tolerance, 1e-4);
  EXPECT_EQ(euler.limiter, EulerOptions::Limiter::none);
  EXPECT_EQ(euler.initial, EulerOptions::Initial::vortex);
  EXPECT_EQ(euler.reference_length, 2);
  EXPECT_EQ(s.solver.kind, SolverSettings::Kind::command);
  EXPECT_EQ(s.solver.command.ranks, 3);
  EXPECT_EQ(s.solver.command.command.arguments, (std::vector<std::string>{"flow", "{mesh}"}));
  EXPECT_EQ(s.solver.command.mesh, "m.mesh");
  EXPECT_EQ(s.solver.command.solution, "s.cgns");
  EXPECT_EQ(s.solver.command.command.timeout, 60);
}

TEST_F(SettingsTest, BoundaryTablesGiveTheMeshItsConditions) {
  const Settings s = read(
      "far_field = 10\n[boundary.\"b*\"]\nbc = \"outflow\"\npressure = 2\n[boundary.box]\nbc = "
      "\"outflow\"\npressure = 0.5\n");
  Mesh mesh;
  mesh.boundaries = {
      {"box", "none", {}}, {"bottom", "wall", {}}, {"farfield", "none", {}}, {"other", "symmetry", {}}};
  const std::vector<flow::BoundaryChoice> choices = euler_options(s.solver, s.outline.rules, mesh).boundaries;
  ASSERT_EQ(choices.size(), 4u);
  EXPECT_EQ(choices[0].condition, BoundaryCondition::outflow);
  EXPECT_EQ(choices[0].pressure, 0.5);
  EXPECT_EQ(choices[1].condition, BoundaryCondition::outflow);
  EXPECT_EQ(choices[1].pressure, 2);
  EXPECT_EQ(choices[2].condition, BoundaryCondition::farfield);
  EXPECT_EQ(choices[3].condition, BoundaryCondition::none);  // the mesh's own stands
  EXPECT_FALSE(choices[3].pressure);
}

TEST_F(SettingsTest, AReynoldsNumberSetsTheViscosity) {
  const EulerOptions o = read("[solver]\nmach = 0.5\nreynolds = 5000\nreference_length = 2\n").solver.euler;
  EXPECT_EQ(o.viscosity, 0.5 * 2 / 5000);
  EXPECT_EQ(o.prandtl, 0.72);
  const EulerOptions given = read("[solver]\nviscosity = 0.25\nprandtl = 1\n").solver.euler;
  EXPECT_EQ(given.viscosity, 0.25);
  EXPECT_EQ(given.prandtl, 1);
  EXPECT_EQ(read("").solver.euler.viscosity, 0);
}

TEST_F(SettingsTest, NeedsAGeometry) {
  const std::string path = folder_.write("none.toml", "title = \"x\"\n");
  EXPECT_EQ(test::refusal(folder_, [&] { read_settings(path, {}); }).find("none.toml"), 0u);
}

TEST_F(SettingsTest, TheDigestFollowsTheSettingsOfTheMesh) {
  const auto digest = [&](const std::vector<std::string>& assignments) {
    const Settings settings = read("[spacing]\nmin = 0.5\nmax = 1\n", assignments);
    return case_digest(mesh_options(settings, load(settings)));
  };
  const auto base = digest({});
  EXPECT_EQ(base, digest({"title=other", "output.prefix=other"}));
  EXPECT_NE(base, digest({"spacing.min=0.25"}));
  EXPECT_NE(base, digest({"spacing.gradation=1.25"}));
  EXPECT_NE(base, digest({"spacing.gap=2"}));
  EXPECT_NE(base, digest({"mesh.snap=0.001"}));
  EXPECT_NE(base, digest({"source=[{disc=[0,0,1],spacing=1}]"}));
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
            "boundary 'ring' requests a spacing of 0.125 at (1, 0), but spacing.min = 0.25 is larger");
  EXPECT_EQ(
      limited[1],
      "boundary 'ring' requests a corner_spacing of 0.0625 at (1, 0), but spacing.min = 0.25 is larger");
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
