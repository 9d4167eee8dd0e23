// Cell sizes along wakes without layers.
#include "generate/sizes_of_wakes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>

#include "generate/digests.hpp"
#include "generate/mesh_trial.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/layers/walls.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// A box of 16 by 16 round a body with a sharp edge at (2, 0) and, with `behind`, a square from x = 4 to 5.
MeshInput body_in_box(const std::optional<LayerSpec>& layers, bool behind) {
  const test::Side box{"box", {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}},
      body{"body", {{2, 0}, {0, -0.3}, {-2, 0}, {0, 0.3}}, layers},
      square{"square", {{4, -0.5}, {4, 0.5}, {5, 0.5}, {5, -0.5}}, layers};
  std::vector<std::vector<test::Side>> loops{{box}, {body}};
  if (behind) loops.push_back({square});
  MeshInput input{test::outline_of(loops), {}, {}, 0};
  input.mesh.size.min = 0.02;
  input.mesh.size.max = 1;
  return input;
}

LayerLine wake_from_body(double length) {
  LayerLine wake;
  wake.from = {"body"};
  wake.at = Point{2, 0};
  wake.length = length;
  wake.spacing = wake.spacing_at_end = 0.1;
  wake.where = "case.toml:9";
  wake.without_layers = true;
  return wake;
}

/// The sources of the only wake.
WakeSizes sizes(MeshInput input, const LayerLine& wake, const MeasuredFlow& measured = {}) {
  input.wakes_without_layers = {wake};
  return sizes_of_wakes(input, measured);
}

const SizeSource::Line& line_of(const SizeSource& source) { return std::get<SizeSource::Line>(source.shape); }

TEST(SizesOfWakes, AStraightWakeIsOneSource) {
  const WakeSizes made = sizes(body_in_box({}, false), wake_from_body(3));
  ASSERT_EQ(made.sources.size(), 1U);
  EXPECT_EQ(line_of(made.sources[0]), (SizeSource::Line{{2, 0}, {5, 0}}));
  EXPECT_EQ(made.sources[0].spacing, 0.1);
  EXPECT_EQ(made.sources[0].where, "case.toml:9");
  EXPECT_TRUE(made.warnings.empty());
}

TEST(SizesOfWakes, EndBeforeOtherBoundaries) {
  const WakeSizes bare = sizes(body_in_box({}, true), wake_from_body(4));
  ASSERT_EQ(bare.sources.size(), 1U);
  EXPECT_NEAR(line_of(bare.sources[0]).to.x, 4 - 2 * 0.1, 1e-14) << "twice the spacing";
  ASSERT_EQ(bare.warnings.size(), 1U);
  EXPECT_EQ(
      bare.warnings[0],
      "case.toml:9: wake ends at (3.8, 0), after 1.8 of its length of 4, before boundary square; reduce "
      "its length, or give it a path = [[x, y], ...] that passes beside it");
  const WakeSizes layered = sizes(body_in_box(test::equal_layers(0.4, 4), true), wake_from_body(4));
  ASSERT_EQ(layered.sources.size(), 1U);
  EXPECT_NEAR(line_of(layered.sources[0]).to.x, 4 - 0.4, 1e-14) << "the thickness of the layers";
  const WakeSizes outside = sizes(body_in_box({}, false), wake_from_body(40));
  EXPECT_NEAR(line_of(outside.sources.at(0)).to.x, 8 - 2 * 0.1, 1e-14);
  EXPECT_NE(outside.warnings.at(0).find("before boundary box"), std::string::npos);
  LayerLine back = wake_from_body(0);
  back.path = {{3, 0}, {3, 2}, {0, 2}, {0, -2}};  // and through the body itself
  const WakeSizes own = sizes(body_in_box({}, false), back);
  EXPECT_NEAR(line_of(own.sources.back()).to.y, 0.3 + 2 * 0.1, 1e-14);
  EXPECT_NE(own.warnings.at(0).find("before boundary body"), std::string::npos);
  LayerLine along = wake_from_body(0);
  along.path = {{3, 0}, {3, 0.5}, {7, 0.5}};  // along the upper side of the square
  EXPECT_NEAR(line_of(sizes(body_in_box({}, true), along).sources.back()).to.x, 4 - 2 * 0.1, 1e-14);
}

TEST(SizesOfWakes, SizesGrowAlongTheRequestedLength) {
  LayerLine wake = wake_from_body(4);
  wake.spacing_at_end = 0.5;
  for (const bool behind : {false, true}) {
    const WakeSizes made = sizes(body_in_box({}, behind), wake);
    ASSERT_GE(made.sources.size(), 4U);
    EXPECT_EQ(made.sources.size() > 6, !behind) << "the shorter one ends with smaller cells";
    Point end{2, 0};
    for (const SizeSource& source : made.sources) {
      const double here = 0.1 + 0.4 * (line_of(source).from.x - 2) / 4;
      EXPECT_EQ(line_of(source).from, end);
      EXPECT_NEAR(source.spacing, here, 1e-14);
      end = line_of(source).to;
    }
    EXPECT_NEAR(end.x, behind ? 3.8 : 6, 1e-14);
  }
}

TEST(SizesOfWakes, FollowAStreamlineWithFewSources) {
  LayerLine wake = wake_from_body(3);
  wake.follows_flow = true;
  MeasuredFlow measured;
  measured.wakes.emplace_back();
  for (int i = 0; i <= 2000; ++i) {
    const double angle = 0.001 * i;
    measured.wakes[0].push_back({2 + 2 * std::sin(angle), 2 - 2 * std::cos(angle)});
  }
  const WakeSizes made = sizes(body_in_box({}, false), wake, measured);
  EXPECT_GT(made.sources.size(), 2U);
  EXPECT_LT(made.sources.size(), 10U);
  double way = 0;
  std::vector<Point> corners{line_of(made.sources[0]).from};
  for (const SizeSource& source : made.sources) {
    way += length(line_of(source).to - line_of(source).from);
    corners.push_back(line_of(source).to);
  }
  EXPECT_NEAR(way, 3, 0.03);
  for (std::size_t i = 0; i < 1500; i += 10)
    EXPECT_LT(distance_to_polyline(measured.wakes[0][i], corners), 0.0251) << "a quarter of the spacing";
  MeasuredFlow elsewhere;
  elsewhere.wakes = {{{5, 5}, {7, 5}}};
  const WakeSizes straight = sizes(body_in_box({}, false), wake, elsewhere);
  EXPECT_EQ(line_of(straight.sources.back()).to, (Point{5, 0}));
  EXPECT_NEAR(straight.sources.back().spacing, 0.1 + 0.05 * (line_of(straight.sources.back()).from.x - 2),
              1e-14);
}

/// The largest distance across the cells that meet the line y = 0 from x = 2.2 to 4.
double size_behind_body(const Mesh& whole) {
  double largest = 0;
  const auto look_at = [&](const auto& cells) {
    for (const auto& cell : cells) {
      Box box;
      for (const NodeId node : cell) box.include(whole.point(node));
      if (box.meets({{2.2, 0}, {4, 0}})) largest = std::max({largest, box.width(), box.height()});
    }
  };
  look_at(whole.triangles);
  look_at(whole.quads);
  return largest;
}

TEST(SizesOfWakes, MeshesHaveTheSizesAndTrialsCountThem) {
  for (const bool layered : {false, true}) {
    MeshInput input = body_in_box(layered ? std::optional(test::equal_layers(0.1, 4)) : std::nullopt, false);
    const std::int64_t before = generate_mesh(world(), input).result.tree.attributes.nodes;
    input.wakes_without_layers = {wake_from_body(3)};
    const MeshResult made = generate_mesh(world(), input).result;
    EXPECT_GT(made.tree.attributes.nodes, before);
    const NodeBounds counted = MeshTrial(world(), input).nodes({});
    EXPECT_LE(counted.least, made.tree.attributes.nodes);
    EXPECT_GE(counted.most, made.tree.attributes.nodes);
    const Mesh whole = gather_whole(world(), made.mesh);
    if (world().is_root()) {
      EXPECT_LT(size_behind_body(whole), 1.5 * 0.1);
      EXPECT_GT(size_behind_body(whole), 0.5 * 0.1);
    }
    const Communicator alone(MPI_COMM_SELF);
    EXPECT_EQ(generate_mesh(alone, input).result.tree.attributes.coordinate_digest,
              made.tree.attributes.coordinate_digest);
  }
}

TEST(SizesOfWakes, WarnOfSizesBelowTheSmallest) {
  LayerLine wake = wake_from_body(3);
  wake.spacing = 0.01;
  const WakeSizes made = sizes(body_in_box({}, false), wake);
  ASSERT_EQ(made.warnings.size(), 1U);
  EXPECT_NE(made.warnings[0].find("spacing of 0.01, but spacing.min = 0.02 is larger"), std::string::npos);
  wake.without_layers = false;
  EXPECT_THROW(sizes(body_in_box({}, false), wake), InputError) << "no layers to continue";
}

TEST(SizesOfWakes, CountForTheDigestOfACase) {
  const MeshInput input = body_in_box({}, false);
  LayerLine growing = wake_from_body(3);
  growing.spacing_at_end = 0.2;
  EXPECT_NE(case_digest(input.mesh, {}, {wake_from_body(3)}), case_digest(input.mesh));
  EXPECT_NE(case_digest(input.mesh, {}, {wake_from_body(3)}), case_digest(input.mesh, {}, {growing}));
}

}  // namespace
}  // namespace quadloop
