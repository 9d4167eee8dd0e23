// Names, layers, lines and files by the hundred: time grows with their number, not with its square.
#include "tests/support/growth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "generate/generate.hpp"
#include "mesher/build/outline_losses.hpp"
#include "mesher/layers/layer_report.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::expect_linear;
using test::world;

constexpr LayerSpec one_layer{0.06, 1, 1, 1};

/// Islands of one shape, each a boundary of its own with layers, in rows of a square frame.
Geometry islands_of(const std::vector<Point>& shape, int count, double spacing, const LayerSpec& layers) {
  const int rows = static_cast<int>(std::ceil(std::sqrt(count)));
  const double end = 4 * rows;
  std::vector<Boundary> boundaries{{.name = "frame", .spacing = 2}};
  std::vector<Point> points{{0, 0}, {end, 0}, {end, end}, {0, end}};
  std::vector<std::int32_t> starts{0, 4};
  std::vector<BoundaryId> of_segment(4, BoundaryId{0});
  for (int island = 0; island < count; ++island) {
    const Point low{4 * (island % rows) + 2.013, 4 * (island / rows) + 2.017};
    boundaries.push_back(
        {.name = "an_island_of_a_long_name_" + std::to_string(island), .spacing = spacing, .layers = layers});
    for (const Point corner : shape) {
      points.push_back(low + corner);
      of_segment.push_back(BoundaryId{size32(boundaries) - 1});
    }
    starts.push_back(size32(points));
  }
  return {std::move(boundaries), std::move(points), std::move(starts), std::move(of_segment)};
}

Geometry islands(int count, double size, const LayerSpec& layers = one_layer) {
  return islands_of({{0, 0}, {0, size}, {size, size}, {size, 0}}, count, size, layers);
}

/// With a sharp nose, where it begins, and a sharp tail 1 behind it.
Geometry darts(int count) {
  return islands_of({{0, 0}, {0.5, 0.2}, {1, 0}, {0.5, -0.2}}, count, 0.2, {0.03, 1.2, 1.2, 2});
}

MeshOptions coarse() {
  MeshOptions options;
  options.size.min = 0.15;
  options.size.max = 2;
  options.may_vanish = true;
  return options;
}

TEST(Growth, OfBoundariesInTheLayerReport) {
  const auto seconds = [](int count) {
    const Geometry geometry = islands(count, 0.16);
    const LayerFront front = layer_front(geometry);
    const Mesh outer = build_mesh(world(), front.outer, coarse()).mesh;
    return test::processor_seconds(
        [&] { EXPECT_EQ(std::ssize(report_layers(world(), front, outer)), count); });
  };
  expect_linear("the report of layers", seconds(250), seconds(8 * 250));
}

/// No island has an edge in the mesh.
TEST(Growth, OfBoundariesThatVanish) {
  expect_linear("boundaries that vanish", 2000, [](int count) {
    const Geometry geometry = islands(count, 0.16);
    Mesh mesh;
    for (const Boundary& boundary : geometry.boundaries())
      mesh.boundaries.push_back({boundary.name, "none", {}});
    MeshReport report;
    report_losses(world(), geometry, mesh, true, report);
    EXPECT_EQ(std::ssize(report.boundaries_vanished), count + 1);
  });
}

TEST(Growth, OfLinesWithLayers) {
  expect_linear("lines", 25, [](int count) {
    MeshInput input{islands(count, 0.3), coarse(), {}, 0};
    for (int k = 0; k < count; ++k) {
      const Point begin = input.geometry.point(input.geometry.loop_start(1 + k)) + Point{0.8, 0.1};
      LayerLine line;
      line.path = {begin, begin + Point{0.7, 0}};
      line.spacing = 0.1;
      line.layers = LayerSpec{0.02, 1.2, 1.2, 2};
      input.lines.push_back(line);
    }
    generate_mesh(world(), input);
  });
}

/// Each from a dart's sharp tail, of a boundary that has a sharp nose too.
std::vector<LayerLine> wakes_of(const Geometry& geometry, int count) {
  std::vector<LayerLine> wakes;
  for (int k = 0; k < count; ++k) {
    LayerLine wake;
    wake.from = {geometry.boundaries()[1 + k].name};
    wake.at = geometry.point(geometry.loop_start(1 + k)) + Point{1, 0};
    wake.length = 0.7;
    wake.spacing = 0.2;
    wakes.push_back(wake);
  }
  return wakes;
}

TEST(Growth, OfWakes) {
  expect_linear("wakes", 25, [](int count) {
    MeshInput input{darts(count), coarse(), {}, 0};
    input.lines = wakes_of(input.geometry, count);
    generate_mesh(world(), input);
  });
  expect_linear("the places of wakes", 1000, [](int count) {
    const Geometry geometry = darts(count);
    EXPECT_EQ(std::ssize(place_lines(geometry, wakes_of(geometry, count))), count);
  });
  expect_linear("the front of wakes", 250, [](int count) {
    const Geometry geometry = darts(count);
    EXPECT_EQ(std::ssize(layer_front(geometry, {}, wakes_of(geometry, count)).strips), count);
  });
}

TEST(Growth, OfLayersOnAWall) {
  expect_linear("layers", 12, [](int count) {
    generate_mesh(world(), {islands(4, 1, {0.005, 1.01, 1.01, count}), coarse(), {}, 0});
  });
}

}  // namespace
}  // namespace quadloop
