// The geometry of the first rank on all ranks, whatever it has: blocks, inner lines, curves, layers.
#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

Geometry on_all_ranks(const Geometry& geometry) {
  return Geometry::once_per_node(world(), world().is_root() ? std::optional(geometry) : std::nullopt);
}

void expect_equal(const Boundary& a, const Boundary& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.spacing, b.spacing);
  EXPECT_EQ(a.corner_degrees, b.corner_degrees);
  EXPECT_EQ(a.condition, b.condition);
  EXPECT_EQ(a.corner_spacing, b.corner_spacing);
  EXPECT_EQ(a.layers, b.layers);
  EXPECT_EQ(a.layers_in, b.layers_in);
  EXPECT_EQ(a.baffle, b.baffle);
}

/// Compares all that the geometry says of its segments and vertices.
void expect_equal(const Geometry& a, const Geometry& b) {
  ASSERT_EQ(a.size(), b.size());
  ASSERT_EQ(a.loop_count(), b.loop_count());
  ASSERT_EQ(a.boundaries().size(), b.boundaries().size());
  for (std::size_t i = 0; i < a.boundaries().size(); ++i) expect_equal(a.boundaries()[i], b.boundaries()[i]);
  EXPECT_EQ(a.block_names(), b.block_names());
  EXPECT_EQ(a.has_twins(), b.has_twins());
  EXPECT_EQ(a.has_curves(), b.has_curves());
  EXPECT_EQ(a.has_inner_lines(), b.has_inner_lines());
  EXPECT_EQ(a.box().low, b.box().low);
  EXPECT_EQ(a.box().high, b.box().high);
  for (std::int32_t v = 0; v < a.size(); ++v) {
    EXPECT_EQ(a.point(v), b.point(v));
    EXPECT_EQ(a.next(v), b.next(v));
    EXPECT_EQ(a.previous(v), b.previous(v));
    EXPECT_EQ(a.boundary_of(v), b.boundary_of(v));
    EXPECT_EQ(a.block_of(v), b.block_of(v));
    EXPECT_EQ(a.twin(v), b.twin(v));
    EXPECT_EQ(a.returns(v), b.returns(v));
    EXPECT_EQ(a.curve(v), b.curve(v));
    EXPECT_EQ(a.kept(v), b.kept(v));
    EXPECT_EQ(a.straight(v), b.straight(v));
    EXPECT_EQ(a.spacing_of(v), b.spacing_of(v));
    EXPECT_EQ(a.bend_degrees(v), b.bend_degrees(v));
    EXPECT_EQ(a.corner_spacing_of(v), b.corner_spacing_of(v));
  }
  EXPECT_EQ(a.digest(), b.digest());
}

/// Two squares beside each other, the second with an inner line that ends in it.
Geometry two_blocks() {
  Boundary wall{"wall", 0.7, 25, "wall", 0.1}, between{"between"}, screen{"screen"};
  wall.layers = LayerSpec{1e-3, 1.3, 1.4, 7, 2, 0.5, true};
  wall.layers_in = "left";
  screen.baffle = true;
  GeometryBuilder builder;
  const BoundaryId w{0}, b{1}, s{2};
  builder.add({0, 0}, w);
  builder.add({1, 0}, b);
  builder.add({1, 1}, w);
  builder.add({0, 1}, w);
  builder.end_loop(0);
  builder.add({1, 0}, w);
  builder.add({2, 0}, s);
  builder.add({1.5, 0.5}, s, {}, true);
  builder.add({2, 0}, w);
  builder.add({2, 1}, w);
  builder.add({1, 1}, b);
  builder.end_loop(1);
  return std::move(builder).geometry({wall, between, screen}, {"left", "right"});
}

Geometry with_curves() {
  GeometryBuilder builder;
  builder.add({0, 0}, BoundaryId{0}, Curve{{{0.5, -0.1}}, {1, 0.9, 1}, 0.25});
  builder.add({1, 0}, BoundaryId{0});
  builder.add({1, 1}, BoundaryId{0}, Curve{{{0.7, 1.1}, {0.3, 1.1}}, {}, 0, true});
  builder.add({0, 1}, BoundaryId{0});
  builder.end_loop();
  return std::move(builder).geometry({Boundary{"lens"}});
}

TEST(GeometryOncePerNode, HasBlocksAndInnerLines) {
  const Geometry geometry = two_blocks();
  ASSERT_TRUE(geometry.has_blocks() && geometry.has_twins() && geometry.has_inner_lines());
  expect_equal(on_all_ranks(geometry), geometry);
}

TEST(GeometryOncePerNode, HasCurves) {
  const Geometry geometry = with_curves();
  ASSERT_TRUE(geometry.is_curved(0) && !geometry.is_curved(1) && geometry.curve(2).interpolates);
  expect_equal(on_all_ranks(geometry), geometry);
}

TEST(GeometryOncePerNode, HasDemandsOfSinglePlaces) {
  const Geometry geometry = with_curves().with({{0.1, 0.2, 0.3, 0.4}, {1, 0, 1, 0}, {0, 5, 0, 7}});
  expect_equal(on_all_ranks(geometry), geometry);
}

TEST(GeometryOncePerNode, ItsMemoryIsSharedAlsoByCopies) {
  const Geometry geometry = on_all_ranks(two_blocks());
  const Geometry copy = geometry;
  EXPECT_EQ(copy.points().data(), geometry.points().data());
}

}  // namespace
}  // namespace quadloop
