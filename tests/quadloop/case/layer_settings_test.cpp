// The tables `layers` of a case: what they mean, and what is refused, by key and line.
#include "quadloop/case/layer_settings.hpp"

#include <gtest/gtest.h>

#include "quadloop/case/case_input.hpp"
#include "quadloop/case/first_height.hpp"
#include "tests/quadloop/case/settings_fixture.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

class LayerSettingsTest : public ::testing::Test {
 protected:
  LayerSettingsTest() { folder_.write("box.geom", "1\nbox\n4\n0 0\n4 0\n4 4\n0 4\n"); }

  CaseInput load(const std::string& layers, const std::string& more = {}) {
    return load_case(
        test::world(),
        {folder_.write("case.toml",
                       "[geometry]\nfile = \"box.geom\"\n[boundary.box]\nlayers = {" + layers + "}\n" + more),
         {},
         {},
         {}},
        warnings_);
  }
  LayerSpec read(const std::string& layers, const std::string& more = {}) {
    return *load(layers, more).mesh->geometry.boundary(BoundaryId{0}).layers;
  }
  void expect_refused(const std::string& layers, const std::string& text, const std::string& more = {}) {
    const std::string said = test::refusal(folder_, [&] { load(layers, more); });
    EXPECT_NE(said.find(text), std::string::npos) << said;
  }

  test::InputFolder folder_;
  Warnings warnings_;  // of what was loaded so far
};

TEST_F(LayerSettingsTest, ReadsEveryKey) {
  EXPECT_EQ(read("first = 1e-3, count = 7"), (LayerSpec{1e-3, 1.2, 1.2, 7, 1}));
  EXPECT_EQ(read("first = 1e-3, count = 7, growth = 1.3, equal = 2"), (LayerSpec{1e-3, 1.3, 1.3, 7, 2}));
  EXPECT_EQ(read("first = 1e-3, count = 7, growth = [1.1, 1.5]"), (LayerSpec{1e-3, 1.1, 1.5, 7, 1}));
  // 1 + 1.5 + 2.25 = 4.75 of the first
  EXPECT_EQ(read("first = 0.01, growth = 1.5, thickness = 0.047").count, 3);
  EXPECT_EQ(read("first = 0.01, growth = 1.5, thickness = 0.048").count, 4);
  EXPECT_EQ(read("first = 0.01, thickness = 0.01").count, 1);
  LayerSpec follows{1e-3, 1.2, 1.2, 7, 1};
  EXPECT_FALSE(follows.follows_flow);
  follows.follows_flow = true;
  EXPECT_EQ(read("first = 1e-3, count = 7, thickness = \"flow\""), follows);
}

TEST_F(LayerSettingsTest, TakesTheFirstHeightFromYPlus) {
  const std::string flow = "[flow]\nreynolds = 6e6\n";
  EXPECT_DOUBLE_EQ(read("first = \"yplus:1\", count = 7", flow).first, height_of_y_plus(1, {6e6, 1}));
  EXPECT_DOUBLE_EQ(
      read("first = \"yplus:0.5\", count = 7", flow + "reference_length = 3\nmach = 0.15\n").first,
      height_of_y_plus(0.5, {6e6, 3}));
  load("first = \"yplus:1\", count = 7", flow);
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(LayerSettingsTest, AYPlusFollowsTheFlowInTheLoop) {
  const std::string adapt = "[adapt]\n", flow = "[flow]\nreynolds = 6e6\n",
                    layers = "first = \"yplus:2\", count = 7";
  const auto of = [&](const std::string& first, const std::string& more) {
    return load(first, more + adapt).settings.adapt->wall_flow;
  };
  EXPECT_EQ(read(layers, flow).y_plus, 2);
  EXPECT_EQ(read("first = 1e-3, count = 7").y_plus, 0);
  EXPECT_EQ(of(layers, flow), (adapt::WallFlow{1 / 6e6, 1, 0.5}));
  EXPECT_EQ(of(layers, flow + "reference_length = 3\ndensity = 2\nspeed = 5\n"),
            (adapt::WallFlow{2 * 5 * 3 / 6e6, 2, 0.5 * 2 * 5 * 5}));
  EXPECT_EQ(of(layers, flow + "[solver]\nmach = 0.5\nreynolds = 5000\n"), (adapt::WallFlow{0.5 / 5000, 1}))
      << "a laminar flow has its own viscosity";
  EXPECT_FALSE(of("first = 1e-3, count = 7", flow));
  const auto line = load(layers, flow + "[[layer_line]]\npath = [[1, 1], [2, 1]]\nspacing = 0.1\n" +
                                     layers.substr(0, 17) + "\ncount = 3\n");
  EXPECT_EQ(line.mesh->lines[0].layers->y_plus, 0) << "a free line has no friction";
}

TEST_F(LayerSettingsTest, SaysThatAFlowDoesNothing) {
  load("first = 1e-3, count = 7", "[flow]\nreynolds = 6e6\n");
  ASSERT_EQ(warnings_.size(), 1U);
  EXPECT_NE(warnings_[0].find("case.toml:5: [flow] does nothing"), std::string::npos) << warnings_[0];
}

TEST_F(LayerSettingsTest, RefusesAFirstHeightThatIsNone) {
  expect_refused("count = 3", "case.toml:4: 'boundary.box.layers.first' is missing");
  for (const char* first : {"0", "-1", "nan", "inf"})
    expect_refused(std::string("count = 3, first = ") + first,
                   "case.toml:4: 'boundary.box.layers.first' is ");
  for (const char* first : {"yplus", "yplus:", "yplus:0", "yplus:-1", "yplus:nan", "yplus:1x", "1e-3"})
    expect_refused(std::string("count = 3, first = \"") + first + "\"", "or \"yplus:1\" with",
                   "[flow]\nreynolds = 6e6\n");
  expect_refused("first = true, count = 3", "'boundary.box.layers.first' must be a number");
  expect_refused("first = 1e-14, count = 3", "boundary box: a first layer of 1e-14 is too thin");
}

TEST_F(LayerSettingsTest, RefusesAFlowThatDoesNotTell) {
  const std::string layers = "first = \"yplus:1\", count = 7";
  expect_refused(layers,
                 "case.toml:4: 'boundary.box.layers.first' is 'yplus:1', which needs a Reynolds number");
  expect_refused(layers, "case.toml:5: 'flow.reynolds' is missing", "[flow]\nmach = 0.1\n");
  expect_refused(layers, "case.toml:6: 'flow.reynolds' is 999, but must be at least 1000",
                 "[flow]\nreynolds = 999\n");
  expect_refused(layers, "'flow.reference_length' is 0", "[flow]\nreynolds = 1e6\nreference_length = 0\n");
  expect_refused(layers, "'flow.mach' is -1", "[flow]\nreynolds = 1e6\nmach = -1\n");
  expect_refused(layers, "unknown key 'flow.re'", "[flow]\nreynolds = 1e6\nre = 2\n");
}

TEST_F(LayerSettingsTest, RefusesNumbersOfLayersAndGrowthsThatCannotBe) {
  expect_refused("first = 1e-3", "case.toml:4: 'boundary.box.layers.count' is missing");
  expect_refused("first = 1e-3, count = 3, thickness = 1",
                 "'boundary.box.layers.thickness' stands beside count");
  expect_refused("first = 1e-3, thickness = \"flow\"", "case.toml:4: 'boundary.box.layers.count' is missing");
  expect_refused("first = 1e-3, count = 3, thickness = \"float\"",
                 "'boundary.box.layers.thickness' is 'float', but must be a number above 0 or \"flow\"");
  expect_refused("first = 1e-3, thickness = 1e-4",
                 "'boundary.box.layers.thickness' is 0.0001, less than the first");
  expect_refused("first = 1e-3, thickness = nan", "'boundary.box.layers.thickness' is nan");
  expect_refused("first = 1e-12, thickness = 1, growth = 1.01", "takes more than 1000 layers");
  for (const char* count : {"0", "1001", "2.5"})
    expect_refused(std::string("first = 1e-3, count = ") + count, "'boundary.box.layers.count' ");
  for (const char* growth : {"1", "0.9", "2.1", "nan", "[1.5, 1.1]", "[1.1, 1.2, 1.3]", "[]", "[1, 1.5]"})
    expect_refused(std::string("first = 1e-3, count = 3, growth = ") + growth,
                   "'boundary.box.layers.growth' ");
  expect_refused("first = 1e-3, count = 3, equal = 0", "'boundary.box.layers.equal' is 0");
  expect_refused("first = 1e-3, count = 3, equal = 4",
                 "'boundary.box.layers.equal' is 4, more than the 3 layers");
  expect_refused("first = 1e-3, count = 3, last = 4", "unknown key 'boundary.box.layers.last'");
}

class LayerTables : public test::SettingsFixture {};

TEST_F(LayerTables, ReadsLayers) {
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

TEST_F(LayerTables, RefusesBadLayers) {
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

TEST_F(LayerTables, ReadsWakesAndFreeLinesWithLayers) {
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

TEST_F(LayerTables, ReadsAWakeThatFollowsTheFlow) {
  const LayerLine wake =
      read("[[wake]]\nfrom = \"box\"\npath = \"flow\"\nlength = 3\nspacing = 0.1\n").lines[0];
  EXPECT_TRUE(wake.follows_flow);
  EXPECT_TRUE(wake.path.empty());
  EXPECT_EQ(wake.length, 3);
  EXPECT_FALSE(read("[[wake]]\nfrom = \"box\"\nlength = 3\nspacing = 0.1\n").lines[0] == wake);
}

TEST_F(LayerTables, ReadsAWakeWithoutLayers) {
  const std::string text = "[[wake]]\nfrom = \"box\"\nlength = 3\nlayers = false\nspacing = ";
  const Settings settings = read(text + "[0.1, 0.3]\n");
  EXPECT_TRUE(settings.lines.empty());
  ASSERT_EQ(settings.wakes_without_layers.size(), 1U);
  const LayerLine& wake = settings.wakes_without_layers[0];
  EXPECT_TRUE(wake.without_layers);
  EXPECT_EQ(wake.spacing, 0.1);
  EXPECT_EQ(wake.spacing_at_end, 0.3);
  EXPECT_EQ(read(text + "0.1\n").wakes_without_layers[0].spacing_at_end, 0.1);
  EXPECT_NE(refused(text + "[0.3, 0.1]\n").find("spacing' must be a number above 0, or two"),
            std::string::npos)
      << refused(text + "[0.3, 0.1]\n");
  EXPECT_NE(refused("[[wake]]\nfrom = \"box\"\nlength = 3\nspacing = [0.1, 0.3]\n")
                .find("only a wake with layers = false"),
            std::string::npos);
}

TEST_F(LayerTables, RefusesBadWakesAndFreeLines) {
  const auto wake = [&](const std::string& text) { return refused("[[wake]]\n" + text + "\n"); };
  const auto line = [&](const std::string& text) { return refused("[[layer_line]]\n" + text + "\n"); };
  const auto has = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  has(wake("length = 1\nspacing = 1"), "from' is missing");
  has(wake("from = \"a\"\nspacing = 1"), "length' is missing: how far the wake goes on, or with path where");
  has(wake("from = \"a\"\nlength = 1\npath = [[1, 1]]\nspacing = 1"), "length' stands beside path");
  has(wake("from = \"a\"\npath = \"flow\"\nspacing = 1"), "length' is missing: how far the wake goes on");
  has(wake("from = \"a\"\npath = \"flaw\"\nlength = 1\nspacing = 1"), "'flaw'");
  has(wake("from = \"a\"\nat = [1]\nlength = 1\nspacing = 1"), "at' ");
  has(wake("from = \"a\"\nlength = 1"), "spacing' is missing");
  has(wake("from = \"a\"\nlength = 1\nspacing = 0"), "spacing' is 0");
  has(wake("from = \"a\"\npath = [[1, 1], [1, 1]]\nspacing = 1"),
      "path' has the point (1, 1) twice in a row");
  has(wake("from = \"a\"\nlength = 1\nspacing = 1\nfirst = 1"), "unknown key");
  has(line("path = [[1, 1]]\nspacing = 1\nfirst = 1\ncount = 1"), "path' must have two points at least");
  has(line("path = [[1, 1], [2, 2]]\nspacing = 1\ncount = 1"), "first' is missing");
  has(line("path = [[1, 1], [2, 2]]\nspacing = 1\nfirst = 1\ncount = 1\nthickness = \"flow\""),
      "thickness' is 'flow', but this line has no wall");
}

}  // namespace
}  // namespace quadloop
