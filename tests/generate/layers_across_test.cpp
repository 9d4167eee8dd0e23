// Layers of a wall on both sides of an inner line that ends on it, and on both sides of a boundary between
// two blocks: they share their last column.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "generate/generate.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

constexpr LayerSpec six_layers{0.01, 1.2, 1.2, 6};  // 0.099 thick together

BoundaryRule layers(const std::string& pattern, const LayerSpec& spec = six_layers) {
  BoundaryRule rule;
  rule.pattern = pattern;
  rule.spacing = 0.08;
  rule.layers = spec;
  return rule;
}

Chain open_chain(const std::string& name, std::vector<Point> points) {
  return {name, true, std::move(points), {}};
}

/// A channel of 3 by 1, whose floor and lid have a point at (1, 0) and (2, 1).
std::vector<Chain> channel() {
  return {open_chain("left_floor", {{0, 0}, {1, 0}}), open_chain("right_floor", {{1, 0}, {3, 0}}),
          open_chain("outlet", {{3, 0}, {3, 1}}), open_chain("lid", {{3, 1}, {2, 1}, {0, 1}}),
          open_chain("inlet", {{0, 1}, {0, 0}})};
}

MeshInput input_of(const std::vector<Chain>& chains, const AssembleOptions& options, MeshType type) {
  Warnings warnings;
  MeshInput made{assemble(chains, options, warnings), {}, {}, 0};
  made.mesh.type = type;
  made.mesh.size.min = 0.015;
  made.mesh.size.max = 0.2;
  made.smooth.sweeps = 5;
  return made;
}

MeshInput with_line(const std::vector<Point>& path, bool baffle, MeshType type,
                    std::vector<BoundaryRule> rules = {layers("*_floor"), layers("lid")}) {
  AssembleOptions options;
  options.lines.push_back({"line", {}, path, baffle, "case"});
  options.rules = std::move(rules);
  return input_of(channel(), options, type);
}

double area_of(const Mesh& whole) {
  double area = 0;
  whole.for_each_cell([&](const auto& nodes) {
    const auto p = corners_of(whole, nodes);
    for (std::size_t k = 1; k + 1 < p.size(); ++k) area += 0.5 * cross(p[k] - p[0], p[k + 1] - p[0]);
  });
  return area;
}

/// The whole mesh on the root, valid and as large as the channel; empty on other ranks.
Mesh sound_mesh(const MeshInput& input) {
  const Mesh whole = gather_whole(world(), generate_mesh(world(), input).result.mesh);
  if (!world().is_root()) return {};
  const auto blocks = static_cast<std::int32_t>(input.geometry.block_names().size());
  const auto faults = blocks == 0
                          ? validate(whole)
                          : validate(whole, {blocks, whole.blocks.of_triangles, whole.blocks.of_quads});
  for (const MeshFault& fault : faults)
    ADD_FAILURE() << name_of(fault.rule) << ": " << fault.what << " at " << fault.place.x << " "
                  << fault.place.y;
  EXPECT_NEAR(area_of(whole), 3, 1e-9);
  return whole;
}

/// The edges of a boundary as one path of points.
std::vector<Point> path_of(const Mesh& whole, const std::string& boundary) {
  const auto found = std::ranges::find(whole.boundaries, boundary, &BoundaryEdges::name);
  if (found == whole.boundaries.end()) return {};
  std::map<NodeId, NodeId> next;
  std::set<NodeId> ends;
  for (const auto& [from, to] : found->edges) {
    EXPECT_TRUE(next.emplace(from, to).second) << boundary << " has two edges at one node";
    ends.insert(to);
  }
  std::vector<Point> path;
  for (const auto& [from, to] : next) {
    if (ends.contains(from)) continue;
    EXPECT_TRUE(path.empty()) << boundary << " is not one path";
    path = {whole.point(from)};
    for (auto at = next.find(from); at != next.end(); at = next.find(at->second))
      path.push_back(whole.point(at->second));
  }
  EXPECT_EQ(path.size(), found->edges.size() + 1) << boundary;
  return path;
}

/// The first nodes of a path are those of a column of six_layers that leans by the given cosine.
void expect_column(const std::vector<Point>& path, double cosine) {
  ASSERT_GT(path.size(), 7U);
  double height = six_layers.first, reached = 0;
  for (std::size_t k = 1; k <= 6; ++k, height *= six_layers.growth) {
    reached += height / cosine;
    EXPECT_NEAR(length(path[k] - path[0]), reached, 1e-9) << k;
  }
}

double cosine_to_normal(const std::vector<Point>& path) {
  const Point along = path.back() - path.front();
  return std::abs(along.y) / length(along);
}

TEST(LayersAcross, AMeasuringLineFromWallToWallHasTheirColumnsAtBothEnds) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    for (const double top : {0.2, 1., 1.4, 1.9}) {
      const std::vector<Point> path{{1, 0}, {top, 1}};
      const Mesh whole = sound_mesh(with_line(path, false, type));
      if (!world().is_root()) continue;
      std::vector<Point> found = path_of(whole, "line");
      ASSERT_FALSE(found.empty());
      EXPECT_EQ(found.front(), path.front());
      EXPECT_EQ(found.back(), path.back());
      expect_column(found, cosine_to_normal(path));
      std::ranges::reverse(found);
      expect_column(found, cosine_to_normal(path));
    }
  }
}

TEST(LayersAcross, ABaffleHasTheSameColumnOnBothSides) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    const std::vector<Point> path{{1, 0}, {1.3, 0.6}};
    const Mesh whole = sound_mesh(with_line(path, true, type));
    if (!world().is_root()) continue;
    const std::vector<Point> left = path_of(whole, "line");
    std::vector<Point> right = path_of(whole, "line__right");
    std::ranges::reverse(right);
    EXPECT_EQ(left, right);
    expect_column(left, cosine_to_normal(path));
    EXPECT_EQ(std::ranges::count(whole.points, path.front()), 2) << "each side has its own foot";
    EXPECT_EQ(std::ranges::count(whole.points, left[3]), 2);
    EXPECT_EQ(std::ranges::count(whole.points, path.back()), 1);
  }
}

TEST(LayersAcross, AShortLineHasThinnerLayersAtItsFoot) {
  const Mesh whole = sound_mesh(with_line({{1, 0}, {1, 0.06}}, false, MeshType::hybrid));
  if (!world().is_root()) return;
  const std::vector<Point> found = path_of(whole, "line");
  ASSERT_GT(found.size(), 7U);
  EXPECT_LT(found[6].y, 0.06);
  EXPECT_GT(found[6].y, 0.03);
}

TEST(LayersAcross, HeightsMayDifferIfCountsAreEqual) {
  const LayerSpec thinner{0.005, 1.2, 1.2, 6};
  const std::vector<BoundaryRule> rules{layers("left_floor"), layers("right_floor", thinner)};
  const Mesh whole = sound_mesh(with_line({{1, 0}, {1, 1}}, false, MeshType::hybrid, rules));
  if (!world().is_root()) return;
  const std::vector<Point> found = path_of(whole, "line");
  ASSERT_GT(found.size(), 7U);
  EXPECT_NEAR(found[6].y, layers_thickness(thinner), 1e-9);
}

MeshInput with_blocks(MeshType type, double top, std::vector<BoundaryRule> rules) {
  AssembleOptions options;
  options.blocks = {{"fluid", {}, {}, Point{0.3, 0.5}, "case"}, {"porous", {}, {}, Point{2.7, 0.5}, "case"}};
  options.rules = std::move(rules);
  std::vector<Chain> chains = channel();
  chains.push_back(open_chain("interface", {{1, 0}, {top, 1}}));
  return input_of(chains, options, type);
}

TEST(LayersAcross, ThoseOfAChannelPassFromBlockToBlock) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    for (const double top : {1., 0.3, 1.8}) {
      const MeshInput input = with_blocks(type, top, {layers("*_floor"), layers("lid")});
      const Mesh whole = sound_mesh(input);
      if (!world().is_root()) continue;
      std::vector<Point> found = path_of(whole, "interface");
      ASSERT_FALSE(found.empty());
      const double cosine = cosine_to_normal({{1, 0}, {top, 1}});
      expect_column(found, cosine);
      std::ranges::reverse(found);
      expect_column(found, cosine);
    }
  }
}

std::string refusal_of(const MeshInput& input) {
  try {
    generate_mesh(world(), input);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
}

TEST(LayersAcross, NoneOnTheOtherSideAreRefusedWithPlaceAndRemedy) {
  expect_parts(refusal_of(with_line({{1, 0}, {1, 0.5}}, false, MeshType::hybrid, {layers("left_floor")})),
               {"boundary left_floor: its layers", "at (1, 0) on inner line 'line'", "right_floor has none",
                "end the line outside the layers"});
  expect_parts(refusal_of(with_blocks(MeshType::hybrid, 1, {layers("left_floor")})),
               {"boundary left_floor: its layers", "in block 'fluid' end at (1, 0) on boundary interface",
                "right_floor has none in block 'porous'", "layers_in = \"fluid\""});
}

TEST(LayersAcross, OtherCountsFlatAnglesAndTwoLinesAreRefused) {
  const LayerSpec fewer{0.01, 1.2, 1.2, 5};
  expect_parts(refusal_of(with_line({{1, 0}, {1, 0.5}}, false, MeshType::hybrid,
                                    {layers("left_floor"), layers("right_floor", fewer)})),
               {"left_floor and right_floor meet at (1, 0)", "give both the same count"});
  expect_parts(refusal_of(with_line({{1, 0}, {1.5, 0.2}}, false, MeshType::hybrid)),
               {"at (1, 0) on inner line 'line'", "45 to 135 degrees"});
  AssembleOptions options;
  options.lines.push_back({"line", {}, {{1, 0}, {0.8, 0.5}}, false, "case"});
  options.lines.push_back({"other", {}, {{1, 0}, {1.2, 0.5}}, false, "case"});
  options.rules = {layers("*_floor")};
  expect_parts(refusal_of(input_of(channel(), options, MeshType::hybrid)),
               {"at (1, 0) on inner line", "ends there too"});
}

/// A line that begins at a wall without layers must not make cells smaller there.
TEST(LayersAcross, ALineAtABareWallAddsNoCellsInEitherDirection) {
  const auto nodes_of = [](const std::vector<Point>& path) {
    return std::ssize(sound_mesh(with_line(path, false, MeshType::hybrid, {layers("*_floor")})).points);
  };
  EXPECT_EQ(nodes_of({{2, 1}, {2, 0.5}}), nodes_of({{2, 0.5}, {2, 1}}));
}

}  // namespace
}  // namespace quadloop
