// Lines over axes, and the tables that they come from.
#include "io/plot/canvas/chart.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "io/plot/canvas/flow_charts.hpp"
#include "io/plot/canvas/sheet.hpp"
#include "io/plot/canvas/ticks.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace quadloop::io {
namespace {

TEST(Ticks, AreRoundNumbersOrDecades) {
  EXPECT_EQ(round_ticks(0, 40.2, 60).values.back(), 40);  // a long axis has no more than 40
  EXPECT_EQ(round_ticks(0.13, 0.61, 5).labels, (std::vector<std::string>{"0.2", "0.3", "0.4", "0.5", "0.6"}));
  EXPECT_EQ(decade_ticks(2e-5, 3, 10).labels,
            (std::vector<std::string>{"1e-4", "1e-3", "1e-2", "1e-1", "1e0"}));
  EXPECT_EQ(decade_ticks(1e-12, 1, 4).labels, (std::vector<std::string>{"1e-12", "1e-8", "1e-4", "1e0"}));
}

TEST(Sheets, InCentimetresAreThoseOfPrint) {
  const Sheet png = sheet_of(Point{25.4, 12.7}, PlotFormat::png),
              pdf = sheet_of(Point{25.4, 12.7}, PlotFormat::pdf);
  EXPECT_NEAR(png.size->x * png.scale, 3000, 1e-9) << "ten inches of 300 dots";
  EXPECT_NEAR(pdf.size->y * pdf.scale, 360, 1e-9) << "five inches of 72 points";
  EXPECT_FALSE(sheet_of({}, PlotFormat::png).size.has_value());
  EXPECT_EQ(sheet_of({}, PlotFormat::png).scale, 1);
}

Chart one_line(std::vector<Point> points) { return {{"x"}, {{{"y"}, {{"a", std::move(points)}}}}}; }

TEST(Chart, IsAPictureTheSameEachTime) {
  const Chart chart = one_line({{0, 1}, {1, 3}, {2, std::nan("")}, {3, 2}});
  const std::string picture = draw_chart(chart, 400, {}, PlotFormat::png);
  EXPECT_TRUE(picture.starts_with("\x89PNG"));
  EXPECT_TRUE(draw_chart(chart, 400, {}, PlotFormat::png) == picture);
  EXPECT_TRUE(draw_chart(chart, 400, Point{8, 5}, PlotFormat::pdf).starts_with("%PDF"));
  Chart reversed = chart;
  reversed.panels[0].y.reversed = true;
  EXPECT_FALSE(draw_chart(reversed, 400, {}, PlotFormat::png) == picture);
  Chart logarithmic = chart;
  logarithmic.panels[0].y.logarithmic = true;
  EXPECT_FALSE(draw_chart(logarithmic, 400, {}, PlotFormat::png) == picture);
  Chart part = chart;
  part.x.range = {0.5, 0.6};
  EXPECT_FALSE(draw_chart(part, 400, {}, PlotFormat::png) == picture);
}

TEST(Chart, DrawsOneValueAndRefusesNone) {
  EXPECT_FALSE(draw_chart(one_line({{0, 5}, {1, 5}}), 400, {}, PlotFormat::png).empty());
  EXPECT_THROW(draw_chart(one_line({}), 400, {}, PlotFormat::png), InputError);
  Chart logarithmic = one_line({{0, -1}, {1, 0}});
  logarithmic.panels[0].y.logarithmic = true;
  EXPECT_THROW(draw_chart(logarithmic, 400, {}, PlotFormat::png), InputError);
}

class Tables : public testing::Test {
 protected:
  PlotTable table(const std::string& text) const {
    test::write_bytes(path_, text);
    return read_plot_table(path_);
  }

  test::TemporaryFolder folder_;
  std::string path_ = folder_.file("t.csv");
};

TEST_F(Tables, AreReadByTheNamesOfTheirColumns) {
  const PlotTable read = table("boundary,s,\"a \"\"b\"\"\"\r\n\"x,y\",1,2.5\r\n\nz,3,-1e-3\n");
  EXPECT_EQ(read.columns, (std::vector<std::string>{"boundary", "s", "a \"b\""}));
  EXPECT_EQ(read.words("boundary"), (std::vector<std::string>{"x,y", "z"}));
  EXPECT_EQ(read.numbers("a \"b\""), (std::vector<double>{2.5, -1e-3}));
  EXPECT_TRUE(read.has("s"));
  EXPECT_FALSE(read.has("t"));
  EXPECT_THROW(read.numbers("boundary"), InputError);
  EXPECT_THROW(read.numbers("t"), InputError);
  EXPECT_THROW(table("a,b\n1\n"), InputError);
}

TEST_F(Tables, OfWallsBecomeALineForEachChain) {
  const PlotTable walls =
      table("boundary,s,x,y,Cp,Mach\na,0,1,0,1,0\na,1,0,0,2,0\na,0,5,0,3,0\na,2,6,0,4,0\nb,3,7,0,5,0\n");
  const Chart chart = wall_chart(walls, "Cp", {});
  const auto& lines = chart.panels.at(0).lines;
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0].points, (std::vector<Point>{{1, 1}, {0, 2}}));
  EXPECT_EQ(lines[1].name, "a");
  EXPECT_EQ(lines[2].name, "b");
  EXPECT_TRUE(chart.panels[0].y.reversed);
  EXPECT_FALSE(wall_chart(walls, "Mach", {}).panels[0].y.reversed);
  const Chart part = wall_chart(walls, "Cp", Box{{0, -1}, {2, 3}});
  EXPECT_EQ(part.x.range, (std::array<double, 2>{0, 2}));
  EXPECT_EQ(part.panels[0].y.range, (std::array<double, 2>{-1, 3}));
  EXPECT_THROW(wall_chart(table("boundary,s,x,y,Cp\n"), "Cp", {}), InputError);
}

TEST_F(Tables, OfHistoriesFollowEachOther) {
  const PlotTable history = table("step,residual,cl,cd\n0,1,0,0\n10,0.1,0.3,0.02\n");
  const Chart chart = history_chart({history, history});
  ASSERT_EQ(chart.panels.size(), 3U);
  EXPECT_EQ(chart.flags, (std::vector<double>{10}));
  EXPECT_EQ(chart.panels[1].lines.at(0).points, (std::vector<Point>{{0, 0}, {10, 0.3}, {10, 0}, {20, 0.3}}));
  EXPECT_TRUE(chart.panels[0].y.logarithmic);
  EXPECT_TRUE(history_chart({history}).flags.empty());
}

}  // namespace
}  // namespace quadloop::io
