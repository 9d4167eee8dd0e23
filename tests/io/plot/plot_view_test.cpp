// Where things lie on the sheet, what colours they have, and that the same calls give the same picture. On
// one rank alone.
#include "io/plot/plot_view.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <limits>

#include "io/plot/canvas/plot_canvas.hpp"
#include "io/plot/cell_paint.hpp"
#include "io/plot/mesh_plot.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"

namespace quadloop::io {
namespace {

PlotView view_of(const Box& window) { return {window, 1600, {}, false}; }

TEST(PlotView, TheWindowFillsTheFrameUpright) {
  const Box window{{-1, 2}, {3, 4}};
  const PlotView view = view_of(window);
  EXPECT_NEAR(view.pixel({-1, 4}).x, view.frame().low.x, 1e-9);
  EXPECT_NEAR(view.pixel({-1, 4}).y, view.frame().low.y, 1e-9);
  EXPECT_NEAR(view.pixel({3, 2}).x, view.frame().high.x, 1e-9);
  EXPECT_NEAR(view.pixel({3, 2}).y, view.frame().high.y, 1e-9);
  EXPECT_NEAR(view.frame().width() / view.frame().height(), 2, 1e-9);
}

TEST(PlotView, SheetsKeepToTheSizeAskedFor) {
  const std::vector<LegendEntry> many(40, {{}, "a boundary of some length"});
  for (const Box& window : {Box{{0, 0}, {1, 1}}, Box{{0, 0}, {1, 1e-7}}, Box{{0, 0}, {1e-7, 1}}}) {
    for (const auto& legend : {std::vector<LegendEntry>{}, many}) {
      const PlotView view(window, 1600, legend, true);
      EXPECT_LE(view.width(), 1601);
      EXPECT_GE(view.frame().width(), 1);
      EXPECT_GE(view.frame().height(), 1);
      EXPECT_LT(view.frame().high.y, view.height());
    }
  }
}

TEST(PlotView, OfFarCellsTheVisiblePartAloneIsDrawn) {
  const PlotView view = view_of({{0, 0}, {1, 1}});
  const std::vector<Point> inside{{0.1, 0.1}, {0.9, 0.1}, {0.5, 0.9}};
  EXPECT_EQ(view.visible_part(inside), inside);
  for (const Point p : view.visible_part({{-1e9, -1e9}, {1e9, -1e9}, {1e9, 1e9}, {-1e9, 1e9}})) {
    EXPECT_LT(std::abs(p.x), 2);
    EXPECT_LT(std::abs(p.y), 2);
  }
  EXPECT_TRUE(view.visible_part({{5, 5}, {6, 5}, {5, 6}}).empty());
}

TEST(PlotView, OfFarEdgesTheVisiblePartAloneIsDrawn) {
  const PlotView view = view_of({{0, 0}, {1, 1}});
  EXPECT_EQ(view.visible_part({0.2, 0.3}, {0.4, 0.5}), (std::array{Point{0.2, 0.3}, Point{0.4, 0.5}}));
  const auto across = view.visible_part({-1e9, 0.5}, {1e9, 0.5});
  ASSERT_TRUE(across.has_value());
  EXPECT_NEAR((*across)[0].y, 0.5, 1e-6);
  EXPECT_LT((*across)[0].x, 0);
  EXPECT_GT((*across)[0].x, -1);
  EXPECT_GT((*across)[1].x, 1);
  EXPECT_FALSE(view.visible_part({-1, 3}, {3, 7}).has_value()) << "its box meets the window's";
  EXPECT_FALSE(view.visible_part({5, 0}, {5, 1}).has_value());
}

TEST(PlotView, OnASheetOfAGivenSizeFillsIt) {
  const Point sheet{907, 567};
  const Box window{{0, 0}, {1, 1}}, wider = PlotView::filling(window, sheet, true);
  EXPECT_LT(wider.low.x, 0);
  EXPECT_EQ(wider.low.y, 0);
  EXPECT_NEAR(wider.centre().x, 0.5, 1e-12);
  const PlotView view(wider, 1600, {}, true, sheet);
  EXPECT_EQ(view.width(), sheet.x);
  EXPECT_EQ(view.height(), sheet.y);
  EXPECT_NEAR(view.frame().high.x, sheet.x - 150, 1e-6);
  EXPECT_NEAR(view.frame().width() / view.frame().height(), wider.width() / wider.height(), 1e-9);
  EXPECT_GT(PlotView::filling({{0, 0}, {9, 1}}, sheet, false).height(), 1);
}

TEST(Colours, AreMixedAndKeptWithinTheirEnds) {
  const auto same = [](Colour a, Colour b) {
    return a.red == b.red && a.green == b.green && a.blue == b.blue;
  };
  EXPECT_TRUE(same(mixed({0, 0, 0}, {1, 0.5, 0.25}, 0.5), {0.5, 0.25, 0.125}));
  EXPECT_TRUE(same(perceptual_colour(-3), perceptual_colour(0)));
  EXPECT_TRUE(same(perceptual_colour(3), perceptual_colour(1)));
  EXPECT_TRUE(same(quality_colour(-1), quality_colour(0)));
  double before = 0;
  for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {  // ever lighter
    const Colour c = perceptual_colour(t);
    const double light = 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue;
    EXPECT_GT(light, before);
    before = light;
  }
}

LoadedMesh sample() {
  LoadedMesh loaded;
  loaded.mesh = test::sample_mesh(4);
  loaded.triangle_to_block.assign(loaded.mesh.triangles.size(), 0);
  loaded.quad_to_block.assign(loaded.mesh.quads.size(), 0);
  loaded.block_names = {"fluid"};
  return loaded;
}

std::vector<std::size_t> all_cells(const Mesh& mesh) {
  std::vector<std::size_t> cells(cell_count(mesh));
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = i;
  return cells;
}

/// The sample with one variable.
LoadedMesh with_field(double (*value)(std::int32_t node)) {
  LoadedMesh loaded = sample();
  loaded.solution.emplace();
  loaded.solution->names = {"q"};
  for (std::int32_t node = 0; node < loaded.mesh.owned_nodes; ++node)
    loaded.solution->values.push_back(value(node));
  return loaded;
}

CellPaint painted(const LoadedMesh& loaded, const std::string& field) {
  PlotOptions options;
  options.field = field;
  options.smooth = false;
  return paint_cells(Communicator(MPI_COMM_SELF), loaded, all_cells(loaded.mesh), options);
}

TEST(CellPaint, TypesThatAreThereStandInTheLegend) {
  const LoadedMesh loaded = sample();
  const CellPaint both = paint_cells(Communicator(MPI_COMM_SELF), loaded, all_cells(loaded.mesh), {});
  EXPECT_EQ(both.legend.size(), 2U);
  EXPECT_FALSE(both.bar.has_value());
  EXPECT_EQ(both.colours.size(), cell_count(loaded.mesh));
  const CellPaint triangles = paint_cells(Communicator(MPI_COMM_SELF), loaded, {0, 1}, {});
  ASSERT_EQ(triangles.legend.size(), 1U);
  EXPECT_EQ(triangles.legend[0].name, "triangles");
}

TEST(CellPaint, OfManyBlocksTheLegendSaysNothing) {
  LoadedMesh loaded = sample();
  PlotOptions options;
  options.colouring = PlotColouring::block;
  EXPECT_EQ(
      paint_cells(Communicator(MPI_COMM_SELF), loaded, all_cells(loaded.mesh), options).legend.at(0).name,
      "fluid");
  loaded.block_names.clear();
  EXPECT_EQ(
      paint_cells(Communicator(MPI_COMM_SELF), loaded, all_cells(loaded.mesh), options).legend.at(0).name,
      "block 1");
  LoadedMesh many;
  many.mesh = test::sample_mesh(20);
  for (std::size_t i = 0; i < many.mesh.triangles.size(); ++i)
    many.triangle_to_block.push_back(static_cast<std::int32_t>(i));
  many.quad_to_block.assign(many.mesh.quads.size(), 0);
  EXPECT_TRUE(paint_cells(Communicator(MPI_COMM_SELF), many, all_cells(many.mesh), options).legend.empty());
}

TEST(CellPaint, FieldsHaveABarFromTheSmallestToTheLargest) {
  const CellPaint paint = painted(with_field([](std::int32_t node) { return 1.0 * node; }), "q");
  ASSERT_TRUE(paint.bar.has_value());
  EXPECT_LT(paint.bar->low, paint.bar->high);
  EXPECT_EQ(*std::min_element(paint.colours.begin(), paint.colours.end()), 0);
  EXPECT_EQ(*std::max_element(paint.colours.begin(), paint.colours.end()), 255);
}

TEST(CellPaint, ARangeIsTakenAsItIsAskedFor) {
  const LoadedMesh loaded = with_field([](std::int32_t node) { return 1.0 * node; });
  PlotOptions options;
  options.field = "q";
  const CellPaint smooth = paint_cells(Communicator(MPI_COMM_SELF), loaded, all_cells(loaded.mesh), options);
  EXPECT_EQ(smooth.bar->low, 0) << "the least of the nodes' values, not of the cells'";
  EXPECT_EQ(smooth.bar->high, loaded.mesh.owned_nodes - 1);
  options.range = {-3.0, 2.5};
  options.map = "grey";
  const CellPaint paint = paint_cells(Communicator(MPI_COMM_SELF), loaded, all_cells(loaded.mesh), options);
  EXPECT_EQ(paint.bar->low, -3);
  EXPECT_EQ(paint.bar->high, 2.5);
  EXPECT_EQ(paint.bar->colour, colour_map_named("grey"));
}

TEST(CellPaint, AConstantHasABarRoundIt) {
  for (auto* const value : {+[](std::int32_t) { return 7.0; }, +[](std::int32_t) { return 0.0; }}) {
    const CellPaint paint = painted(with_field(value), "q");
    EXPECT_LT(paint.bar->low, value(0));
    EXPECT_GT(paint.bar->high, value(0));
  }
}

TEST(CellPaint, WhatIsNotFiniteIsGrey) {
  const CellPaint paint =
      painted(with_field([](std::int32_t node) { return node == 0 ? NAN : 1.0 * node; }), "q");
  EXPECT_EQ(paint.palette.size(), 257U);
  EXPECT_GT(std::count(paint.colours.begin(), paint.colours.end(), 256), 0);
  EXPECT_TRUE(std::isfinite(paint.bar->low));
  const CellPaint all = painted(with_field([](std::int32_t) { return HUGE_VAL; }), "q");
  EXPECT_EQ(std::count(all.colours.begin(), all.colours.end(), 256), std::ssize(all.colours));
}

TEST(CellPaint, AMissingFieldIsRefusedWithThoseThatAreThere) {
  const LoadedMesh loaded = with_field([](std::int32_t) { return 1.0; });
  EXPECT_THROW(painted(sample(), "q"), InputError);
  try {
    painted(loaded, "p");
    FAIL();
  } catch (const InputError& fault) {
    EXPECT_TRUE(std::string(fault.what()).starts_with("there is no field 'p'; there are: q")) << fault.what();
  }
}

/// Cairo numbers the surfaces of a process in SVG, so of one process the bytes of PNG alone are looked at.
TEST(MeshPlot, IsAPictureOfTheFormatAndTheSameEachTime) {
  const LoadedMesh loaded = sample();
  PlotOptions options;
  options.size = 400;
  EXPECT_TRUE(draw_mesh(Communicator(MPI_COMM_SELF), loaded, options, PlotFormat::svg).starts_with("<?xml"));
  EXPECT_TRUE(draw_mesh(Communicator(MPI_COMM_SELF), loaded, options, PlotFormat::pdf).starts_with("%PDF"));
  const std::string picture = draw_mesh(Communicator(MPI_COMM_SELF), loaded, options, PlotFormat::png);
  EXPECT_TRUE(picture.starts_with("\x89PNG"));
  EXPECT_TRUE(draw_mesh(Communicator(MPI_COMM_SELF), loaded, options, PlotFormat::png) == picture);
  options.colouring = PlotColouring::quality;
  EXPECT_FALSE(draw_mesh(Communicator(MPI_COMM_SELF), loaded, options, PlotFormat::png) == picture);
}

TEST(MeshPlot, WindowsWithoutCellsAreRefused) {
  PlotOptions options;
  for (const Box& window : {Box{{5, 5}, {6, 6}}, Box{{0, 0}, {0, 1}}, Box{{1, 1}, {0, 0}}}) {
    options.window = window;
    EXPECT_THROW(draw_mesh(Communicator(MPI_COMM_SELF), sample(), options, PlotFormat::png), InputError);
  }
}

}  // namespace
}  // namespace quadloop::io
