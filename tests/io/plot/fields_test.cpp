// How a field becomes colours, contour lines and streamlines.
#include <gtest/gtest.h>
#include <mpi.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "io/plot/canvas/colour_map.hpp"
#include "io/plot/contour_lines.hpp"
#include "io/plot/mesh_painter.hpp"
#include "io/plot/mesh_plot.hpp"
#include "io/plot/streamlines.hpp"
#include "io/plot/value_raster.hpp"
#include "mesher/base/error.hpp"
#include "tests/io/sample_mesh.hpp"

namespace quadloop::io {
namespace {

TEST(ColourMaps, HaveNamesAndGoFromEndToEnd) {
  for (const std::string& name : colour_map_names()) {
    const ColourMap map = colour_map_named(name);
    ASSERT_NE(map, nullptr) << name;
    const Colour low = map(-1), start = map(0), end = map(2);
    EXPECT_EQ(low.red, start.red) << name;
    EXPECT_GT(std::abs(start.red - end.red), 0.3) << name;
    for (const double t : {0.0, 0.3, 1.0}) {
      for (const double share : {map(t).red, map(t).green, map(t).blue}) {
        EXPECT_GE(share, 0);
        EXPECT_LE(share, 1);
      }
    }
  }
  EXPECT_EQ(colour_map_named("taste"), nullptr);
}

/// Linear in x and y over triangles that fill the square [0, n] x [0, n].
ValueRaster linear_raster(double n, double resolution, double (*value)(Point)) {
  ValueRaster raster({{0, 0}, {n, n}}, resolution);
  const Point a{0, 0}, b{n, 0}, c{n, n}, d{0, n}, middle{0.37 * n, 0.61 * n};
  for (const auto& [p, q] : {std::pair{a, b}, {b, c}, {c, d}, {d, a}})
    raster.add({{p, q, middle}, {value(p), value(q), value(middle)}});
  return raster;
}

TEST(ValueRaster, HasALinearValueEverywhereWhicheverTrianglesFillIt) {
  const auto value = [](Point p) { return 3 + 2 * p.x - p.y; };
  for (const double resolution : {1.0, 2.5}) {
    const ValueRaster raster = linear_raster(40, resolution, value);
    for (double x = 1; x < 39; x += 0.7) {
      for (double y = 1; y < 39; y += 0.9) EXPECT_NEAR(raster.at({x, y}), value({x, y}), 1e-4);
    }
  }
}

TEST(ValueRaster, LeavesOutWhatNoPieceCovers) {
  ValueRaster raster({{0, 0}, {10, 10}}, 1);
  raster.add({{{{0, 0}, {5, 0}, {0, 5}}}, {1, 1, 1}});
  EXPECT_NEAR(raster.at({1.5, 1.5}), 1, 1e-6);
  EXPECT_TRUE(std::isnan(raster.at({8, 8})));
  EXPECT_TRUE(std::isnan(raster.at({-1, 2})));
  const Image image = raster.image({"q", 0, 2, perceptual_colour});
  EXPECT_EQ(image.width, 10);
  EXPECT_NE(image.pixels[0], 0U);
  EXPECT_EQ(image.pixels.back(), 0U);
}

TEST(ValueRaster, LeavesNoPixelOutBetweenPieces) {
  const Image image = linear_raster(64, 1, [](Point) { return 1.0; }).image({"q", 0, 2, perceptual_colour});
  EXPECT_EQ(std::set(image.pixels.begin(), image.pixels.end()).size(), 1U);
}

TEST(ValueRaster, WhatIsNotFiniteIsGreyAndPiecesWithoutAreaAreNothing) {
  ValueRaster raster({{0, 0}, {4, 4}}, 1);
  raster.add({{{{0, 0}, {2, 2}, {4, 4}}}, {1, 1, 1}});
  EXPECT_TRUE(std::isnan(raster.at({2, 2})));
  raster.add({{{{-9, -9}, {30, -9}, {-9, 30}}}, {1, std::nan(""), 1}});
  const std::uint32_t grey = raster.image({"q", 0, 2, perceptual_colour}).pixels[5];
  EXPECT_EQ((grey >> 16U) & 255U, grey & 255U);
  EXPECT_EQ(grey >> 24U, 255U);
}

/// One cell on [0, 1] x [0, 1], and a view of it.
struct OneQuad {
  ShownCell with(const std::array<double, 4>& values) const {
    return {{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}, values, 4};
  }
  PlotView view{{{0, 0}, {1, 1}}, 800, {}, false};
};

TEST(Pieces, OfAQuadAreBilinear) {
  const OneQuad quad;
  std::vector<LinearPiece> pieces;
  append_pieces(quad.view, quad.with({0, 1, 5, 0}), pieces);  // s + 4 s t
  ValueRaster raster(quad.view.frame(), 1);
  for (const LinearPiece& piece : pieces) raster.add(piece);
  for (const Point p : {Point{0.5, 0.5}, {0.25, 0.75}, {0.9, 0.2}, {0.31, 0.47}})
    EXPECT_NEAR(raster.at(quad.view.pixel(p)), p.x + 4 * p.x * p.y, 4e-3);
  pieces.clear();
  append_pieces(quad.view, quad.with({0, 1, 2, 1}), pieces);
  EXPECT_EQ(pieces.size(), 4U) << "a plane needs no more";
}

TEST(Contours, LieEvenlyWithinTheRange) {
  EXPECT_EQ(contour_levels(1, 3, 3), (std::vector<double>{1.5, 2, 2.5}));
  EXPECT_TRUE(contour_levels(1, 3, 0).empty());
}

TEST(Contours, AreStraightLinesOfEqualValues) {
  const LinearPiece piece{{{{0, 0}, {4, 0}, {0, 4}}}, {0, 4, 8}};  // x + 2 y
  std::vector<std::array<Point, 2>> lines;
  append_contours(piece, {-1, 2, 6, 9}, lines);
  ASSERT_EQ(lines.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) {
    for (const Point& end : lines[k]) EXPECT_NEAR(end.x + 2 * end.y, k == 0 ? 2 : 6, 1e-12);
    EXPECT_GT(length(lines[k][1] - lines[k][0]), 1);
  }
}

TEST(Contours, ThroughCornersHaveNoGapAndFlatPiecesNone) {
  std::vector<std::array<Point, 2>> lines;
  append_contours({{{{0, 0}, {1, 0}, {0, 1}}}, {2, 2, 2}}, {2}, lines);
  EXPECT_TRUE(lines.empty());
  append_contours({{{{0, 0}, {1, 0}, {1, 1}}}, {0, 1, 2}}, {1}, lines);  // through (1, 0)
  append_contours({{{{0, 0}, {1, 1}, {0, 1}}}, {0, 2, 1}}, {1}, lines);  // through (0, 1)
  ASSERT_EQ(lines.size(), 2U);
  append_contours({{{{0, 0}, {1, 1}, {0, 1}}}, {0, std::nan(""), 1}}, {0.5}, lines);
  EXPECT_EQ(lines.size(), 2U);
}

TEST(Streamlines, FollowTheFlowEvenlySpread) {
  const ValueRaster u = linear_raster(200, 1, [](Point) { return 2.0; }),
                    v = linear_raster(200, 1, [](Point) { return 1.0; });
  const auto lines = streamlines(u, v, 10);
  EXPECT_GT(lines.size(), 8U);
  EXPECT_LT(lines.size(), 40U);
  for (const auto& line : lines) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Point step = line[i] - line[i - 1];
      EXPECT_NEAR(step.y / step.x, -0.5, 1e-3) << "upwards is against y on the sheet";
      EXPECT_GT(step.x, 0) << "the way of the flow";
    }
  }
  for (std::size_t a = 0; a < lines.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      for (const Point& p : lines[a]) {
        for (const Point& q : lines[b]) EXPECT_GT(length(p - q), 9.9);
      }
    }
  }
}

TEST(Streamlines, OfAVortexGoRoundOnceAndStopWhereThereIsNoFlow) {
  const ValueRaster u = linear_raster(200, 1, [](Point p) { return p.y - 100; }),
                    v = linear_raster(200, 1, [](Point p) { return p.x - 100; });
  for (const auto& line : streamlines(u, v, 8)) {
    const double radius = length(line[0] - Point{100, 100});
    for (const Point& p : line) EXPECT_NEAR(length(p - Point{100, 100}), radius, 1.5);
    EXPECT_LT(static_cast<double>(line.size()) * 1.5, 2.2 * 6.3 * radius + 10);
  }
  const ValueRaster rest = linear_raster(200, 1, [](Point) { return 0.0; });
  EXPECT_TRUE(streamlines(rest, rest, 8).empty());
}

LoadedMesh with_flow() {
  LoadedMesh loaded;
  loaded.mesh = test::sample_mesh(4);
  loaded.triangle_to_block.assign(loaded.mesh.triangles.size(), 0);
  loaded.quad_to_block.assign(loaded.mesh.quads.size(), 0);
  loaded.solution.emplace();
  loaded.solution->names = {"q", "u", "v"};
  for (const Point& p : loaded.mesh.points)
    loaded.solution->values.insert(loaded.solution->values.end(), {p.x * p.y, 1, 0.2});
  return loaded;
}

/// Ways in which pictures of one field differ, each from all others.
TEST(MeshPlot, ShowsWhatIsAskedFor) {
  const LoadedMesh loaded = with_flow();
  PlotOptions options;
  options.size = 400;
  options.field = "q";
  std::set<std::string> pictures;
  const auto draw = [&] {
    pictures.insert(draw_mesh(Communicator(MPI_COMM_SELF), loaded, options, PlotFormat::png));
  };
  draw();
  options.lines = true;
  draw();
  options.smooth = false;
  draw();
  options = {.field = "q", .window = {}, .size = 400, .contours = 5};
  draw();
  options.range = {0.0, 20.0};
  draw();
  options.map = "grey";
  draw();
  options.streamlines = 5;
  draw();
  options.centimetres = Point{12, 9};
  draw();
  EXPECT_EQ(pictures.size(), 8U);
  draw();
  EXPECT_EQ(pictures.size(), 8U) << "the same each time";
}

TEST(MeshPlot, StreamlinesNeedAVelocity) {
  LoadedMesh loaded = with_flow();
  PlotOptions options;
  options.streamlines = 5;
  loaded.solution->names = {"q", "a", "b"};
  EXPECT_THROW(draw_mesh(Communicator(MPI_COMM_SELF), loaded, options, PlotFormat::png), InputError);
  loaded.solution.reset();
  EXPECT_THROW(draw_mesh(Communicator(MPI_COMM_SELF), loaded, options, PlotFormat::png), InputError);
}

}  // namespace
}  // namespace quadloop::io
