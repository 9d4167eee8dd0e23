// Names, layers, lines and files by the hundred: time grows with their number, not with its square.
#include "tests/support/growth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "mesher/build/outline_losses.hpp"
#include "mesher/generate/generate.hpp"
#include "mesher/layers/layer_report.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::expect_linear;
using test::world;

constexpr LayerSpec one_layer{0.06, 1, 1, 1};

/// Square islands, each a boundary of its own with layers, in rows of a square frame.
Geometry islands(int count, double size, const LayerSpec& layers = one_layer) {
  const int rows = static_cast<int>(std::ceil(std::sqrt(count)));
  const double end = 4 * rows;
  std::vector<Boundary> boundaries{{.name = "frame", .spacing = 2}};
  std::vector<Point> points{{0, 0}, {end, 0}, {end, end}, {0, end}};
  std::vector<std::int32_t> starts{0, 4};
  std::vector<BoundaryId> of_segment(4, BoundaryId{0});
  for (int island = 0; island < count; ++island) {
    const Point low{4 * (island % rows) + 2.013, 4 * (island / rows) + 2.017};
    boundaries.push_back(
        {.name = "an_island_of_a_long_name_" + std::to_string(island), .spacing = size, .layers = layers});
    for (const Point corner : {Point{0, 0}, Point{0, size}, Point{size, size}, Point{size, 0}}) {
      points.push_back(low + corner);
      of_segment.push_back(BoundaryId{size32(boundaries) - 1});
    }
    starts.push_back(size32(points));
  }
  return {std::move(boundaries), std::move(points), std::move(starts), std::move(of_segment)};
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

TEST(Growth, OfLayersOnAWall) {
  expect_linear("layers", 12, [](int count) {
    generate_mesh(world(), {islands(4, 1, {0.005, 1.01, 1.01, count}), coarse(), {}, 0});
  });
}

}  // namespace
}  // namespace quadloop
