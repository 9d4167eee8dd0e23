// Periodic pairs: the nodes on the two sides are images of each other, bit by bit, whatever the grid is.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "generate/digests.hpp"
#include "generate/generate.hpp"
#include "generate/match_pairs.hpp"
#include "generate/pair_sides.hpp"
#include "generate/split_edges.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/assemble/shapes.hpp"
#include "mesher/geometry/turn.hpp"
#include "mesher/mesh/check/delaunay_check.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/check/validate_geometry.hpp"
#include "mesher/mesh/paired_nodes.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

constexpr Point pitch{0.13, 0.7};

/// The S-shaped line below a passage; that above it is its image.
std::vector<Point> passage_line(Point shift) {
  std::vector<Point> line;
  for (int i = 0; i <= 60; ++i) {
    const double x = -1 + i * (3.0 / 60);
    line.push_back(Point{x, 0.35 * std::tanh(2 * x)} + shift);
  }
  return line;
}

BoundaryRule rule(const std::string& boundary, double spacing, std::optional<LayerSpec> layers = {}) {
  BoundaryRule rule;
  rule.pattern = boundary;
  rule.spacing = spacing;
  rule.layers = layers;
  return rule;
}

MeshInput input_of(std::vector<Chain> chains, const PeriodicPair& pair, double size,
                   std::vector<BoundaryRule> rules = {}) {
  AssembleOptions options;
  options.pairs = {{pair, "case.toml:1"}};
  options.rules = std::move(rules);
  Warnings warnings;
  MeshInput input{assemble(std::move(chains), options, warnings), {}, {}, 0};
  input.mesh.size.max = size;
  input.mesh.size.min = size / 8;
  input.mesh.pairs = {pair};
  input.mesh.size.periods = {pair.translation};
  input.smooth.sweeps = 10;
  input.digest = case_digest(input.mesh);
  return input;
}

/// A passage between curved lines, whose pitch is no multiple of any cell. A disc near the lower line makes
/// the cells there small.
MeshInput passage() {
  const std::vector<Point> lower = passage_line({}), upper = passage_line(pitch);
  Chain from{"lower", true, lower, "a"}, to{"upper", true, {upper.rbegin(), upper.rend()}, "b"};
  Chain inlet{"inlet", true, {upper.front(), lower.front()}, "c"},
      outlet{"outlet", true, {lower.back(), upper.back()}, "d"};
  return input_of({from, outlet, to, inlet, circle("disc", {0.5, 0.47}, 0.06, "e")},
                  {"lower", "upper", pitch}, 0.11, {rule("disc", 0.02)});
}

/// A sector of a ring, whose sides a rotation by 50 degrees maps onto each other.
MeshInput sector(std::vector<BoundaryRule> rules = {}) {
  std::vector<Point> inner, outer, side{{1, 0}, {1.4, 0.06}, {2, 0}};
  for (int i = 0; i <= 20; ++i) {
    const Point at = unit_vector(i * 2.5);
    inner.push_back(at);
    outer.push_back(2 * at);
  }
  std::vector<Point> turned;
  for (const Point p : side) turned.push_back(turned_about({}, p, unit_vector(50)));
  return input_of({{"from", true, side, "a"},
                   {"outer", true, outer, "b"},
                   {"to", true, {turned.rbegin(), turned.rend()}, "c"},
                   {"inner", true, {inner.rbegin(), inner.rend()}, "d"}},
                  {"from", "to", {}, 50, {}}, 0.13, std::move(rules));
}

/// A straight channel with a disc near its inlet.
MeshInput channel(double length, std::vector<BoundaryRule> rules = {}) {
  return input_of({{"bottom", true, {{0, 0}, {length, 0}}, "a"},
                   {"right", true, {{length, 0}, {length, 1}}, "b"},
                   {"top", true, {{length, 1}, {0, 1}}, "c"},
                   {"left", true, {{0, 1}, {0, 0}}, "d"},
                   circle("disc", {0.3, 0.45}, 0.1, "e")},
                  {"left", "right", {length, 0}}, 0.1, std::move(rules));
}

/// The mesh is valid, and partners are exact images.
void expect_paired(const MeshInput& input, const char* what) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshInput of_type = input;
    of_type.mesh.type = type;
    const MeshResult made = generate_mesh(world(), of_type).result;
    const PeriodicPair& pair = of_type.mesh.pairs.front();
    ASSERT_EQ(made.mesh.pairs, of_type.mesh.pairs);
    const PairedNodes nodes = paired_nodes(world(), made.mesh, pair);
    EXPECT_GT(nodes.from.nodes.size(), 8U) << what;
    for (std::size_t i = 0; i < nodes.from.nodes.size(); ++i)
      EXPECT_EQ(pair.image(nodes.from.points[i]), nodes.to.points[i]) << what << " " << i;
    EXPECT_EQ(made.tree.attributes.coordinate_digest,
              generate_mesh(Communicator(MPI_COMM_SELF), of_type).result.tree.attributes.coordinate_digest)
        << what;
    std::int64_t of_leaves = 0;
    for (const LeafRecord& leaf : made.tree.leaves) of_leaves += leaf.triangles;
    EXPECT_EQ(of_leaves, std::ssize(made.mesh.triangles)) << what;
    const bool has_layers = std::ranges::any_of(input.geometry.boundaries(),
                                                [](const Boundary& b) { return b.layers.has_value(); });
    EXPECT_GT(summarise_quality(world(), made.mesh).smallest_degrees, has_layers ? 5 : 12) << what;
    const Mesh whole = gather_whole(world(), made.mesh);
    if (!world().is_root()) continue;
    for (const MeshFault& fault : validate(whole)) ADD_FAILURE() << what << ": " << fault.what;
    for (const MeshFault& fault : validate_geometry(whole, chains_of(input.geometry)).faults)
      ADD_FAILURE() << what << ": " << fault.what;
    EXPECT_TRUE(has_layers || is_delaunay(whole) == (type == MeshType::delaunay)) << what;
  }
}

TEST(Pairs, NodesMatchAlongCurvedLinesBetweenGridLines) { expect_paired(passage(), "passage"); }
TEST(Pairs, NodesMatchUnderARotation) { expect_paired(sector(), "sector"); }
TEST(Pairs, NodesMatchOnSidesOfTheGrid) { expect_paired(channel(2), "channel"); }
TEST(Pairs, NodesMatchOnOneGridLineOnly) {
  MeshInput input = channel(2.137);
  input.mesh.size.periods.clear();
  expect_paired(input, "channel between grid lines");
}

TEST(Pairs, LayersEndAtThemAlike) {
  const LayerSpec layers{0.004, 1.3, 1.3, 7};
  expect_paired(channel(2.137, {rule("bottom", 0.06, layers), rule("top", 0.06, layers)}), "layers");
}

TEST(Pairs, LayersThatWouldEndAtOtherHeightsAreEquallyThick) {
  const LayerSpec layers{0.005, 1.3, 1.3, 6};  // the sides are not normal to the walls
  expect_paired(sector({rule("inner", 0.08, layers), rule("outer", 0.1, layers)}), "sector with layers");
}

TEST(Pairs, SizesAreThoseOfThePartner) {
  // Without the pair only the cells near the disc are small.
  const MeshInput input = channel(2);
  DemandedSplits splits;
  const MeshResult once = build_mesh(world(), input.geometry, input.mesh);
  ASSERT_TRUE(demand_sizes_of_partners(world(), input.geometry, input.mesh.pairs, once, splits));
  const MeshResult again = build_mesh(world(), input.geometry, input.mesh, splits);
  EXPECT_GT(world().sum(again.mesh.owned_nodes), world().sum(once.mesh.owned_nodes));
  EXPECT_LT(world().sum(again.mesh.owned_nodes), 2 * world().sum(once.mesh.owned_nodes));
  const auto nodes_on = [](const MeshResult& made, const char* boundary) {
    return line_of_boundary(world(), made.mesh, boundary)->nodes.size();
  };
  EXPECT_LT(nodes_on(once, "right"), nodes_on(once, "left"));
  const MeshResult made = generate_mesh(world(), input).result;
  EXPECT_FALSE(demand_sizes_of_partners(world(), input.geometry, input.mesh.pairs, made, splits));
  EXPECT_GE(nodes_on(made, "right"), nodes_on(once, "left"));
}

/// The quadtree cells of a mesh on one rank that have mesh cells, with their boxes.
std::vector<std::pair<LeafRecord, Box>> leaves_with_cells(const MeshInput& input, const MeshResult& made) {
  std::vector<std::pair<LeafRecord, Box>> leaves;
  const TreeGrid grid = input.grid();
  for (const LeafRecord& leaf : made.tree.leaves) {
    const auto at = [](std::int32_t tree, std::int32_t in_tree) {
      return (std::int64_t{tree} << Quadrant::unit_level) + in_tree;
    };
    if (has_cells(leaf))
      leaves.emplace_back(leaf, grid.box_of({at(leaf.tree_x, leaf.x), at(leaf.tree_y, leaf.y), leaf.level}));
  }
  return leaves;
}

/// The largest ratio of a leaf's size to the growth limit from leaves with a wanted size that are moved by
/// one of the shifts.
double largest_growth(const MeshInput& input, const MeshResult& made, const std::vector<Point>& shifts) {
  const auto leaves = leaves_with_cells(input, made);
  const TreeGrid grid = input.grid();
  double largest = 0;
  for (const auto& [leaf, box] : leaves) {
    for (const auto& [wanted, other] : leaves) {
      const double size = grid.edge(wanted.wanted);
      for (const Point shift : shifts) {
        const Point low = other.low + shift, high = other.high + shift;
        const double gap =
            std::max({box.low.x - high.x, low.x - box.high.x, box.low.y - high.y, low.y - box.high.y});
        if (gap > 0)
          largest = std::max(largest, box.width() / (size + (input.mesh.size.gradation - 1) / 2 * gap));
      }
    }
  }
  return largest;
}

TEST(Pairs, SizesGrowAcrossThemAsElsewhere) {
  const double length = 2.137;
  const MeshInput input = channel(length, {rule("disc", 0.02)});
  const Communicator self(MPI_COMM_SELF);
  const std::vector<Point> across{{length, 0}, {-length, 0}};
  const MeshResult made = generate_mesh(self, input).result;
  EXPECT_LE(largest_growth(input, made, {{0, 0}}), 1 + 1e-9);
  EXPECT_LE(largest_growth(input, made, across), 1 + 1e-9);
  EXPECT_GT(largest_growth(input, build_mesh(self, input.geometry, input.mesh), across), 1.1)
      << "without the pair";
}

/// The quadtree cells at one side of a channel between curved walls are those at the other, moved.
TEST(Pairs, TheTreeIsPeriodicAlongATranslationOnAnAxis) {
  const double length = 2.137;
  std::vector<Point> floor;
  for (int i = 0; i <= 40; ++i)
    floor.push_back({i * length / 40, 0.1 - 0.1 * std::cos(i * std::numbers::pi / 20)});
  const MeshInput input = input_of({{"bottom", true, floor, "a"},
                                    {"right", true, {{length, 0}, {length, 1}}, "b"},
                                    {"top", true, {{length, 1}, {0, 1}}, "c"},
                                    {"left", true, {{0, 1}, {0, 0}}, "d"},
                                    circle("disc", {0.3, 0.55}, 0.1, "e")},
                                   {"left", "right", {length, 0}}, 0.1);
  expect_paired(input, "curved floor");
  const MeshResult made = generate_mesh(Communicator(MPI_COMM_SELF), input).result;
  std::vector<std::array<double, 3>> left, right;
  for (const auto& [leaf, box] : leaves_with_cells(input, made)) {
    if (box.low.x == 0) left.push_back({box.low.y, box.high.y, box.width()});
    if (box.high.x == length) right.push_back({box.low.y, box.high.y, box.width()});
  }
  std::ranges::sort(left);
  std::ranges::sort(right);
  EXPECT_GT(left.size(), 9U);
  EXPECT_EQ(left.size(), right.size());
  for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i) {
    EXPECT_EQ(left[i][0], right[i][0]);
    EXPECT_EQ(left[i][1], right[i][1]);
  }
}

TEST(Pairs, OutlinesThatDoNotMatchAreRefused) {
  const auto outline = [](Point end) {
    return std::vector<Chain>{{"bottom", true, {{0, 0}, {2, 0}}, "a"},
                              {"right", true, {{2, 0}, end}, "b"},
                              {"top", true, {end, {0, 1}}, "c"},
                              {"left", true, {{0, 1}, {0, 0}}, "d"}};
  };
  AssembleOptions options;
  options.pairs = {{{"left", "right", {2, 0}}, "case.toml:7"}};
  Warnings warnings;
  try {
    assemble(outline({2, 1.25}), options, warnings);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("case.toml:7"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("0.25 apart at (2, 1.25)"), std::string::npos) << error.what();
  }
  const Geometry near = assemble(outline({2, 1.000001}), options, warnings);
  EXPECT_EQ(warnings.size(), 1U) << "moved";
  EXPECT_EQ(near.box().high, (Point{2, 1}));
}

TEST(Pairs, AnEdgeIsDividedWithItsCell) {
  MeshInput input = channel(2);
  MeshResult made = build_mesh(world(), input.geometry, input.mesh);
  const BoundaryLine line = *line_of_boundary(world(), made.mesh, "bottom");
  const Point a = line.points[1], b = line.points[2];
  const std::int64_t before = world().sum(made.mesh.owned_nodes);
  split_edges(world(), {{line.nodes[1], line.nodes[2], {0.75 * a + 0.25 * b, 0.5 * a + 0.5 * b}}}, made);
  EXPECT_EQ(world().sum(made.mesh.owned_nodes), before + 2);
  EXPECT_EQ(line_of_boundary(world(), made.mesh, "bottom")->nodes.size(), line.nodes.size() + 2);
  const Mesh whole = gather_whole(world(), made.mesh);
  if (!world().is_root()) return;
  EXPECT_TRUE(validate(whole).empty());
}

TEST(Pairs, AnOutlineKnowsItsArcLengths) {
  const MeshInput input = sector();
  const PairOutline outline(input.geometry, input.mesh.pairs.front());
  EXPECT_EQ(outline.on_from(0), (Point{1, 0}));
  EXPECT_EQ(outline.on_from(outline.length()), (Point{2, 0}));
  EXPECT_TRUE(outline.kept_at(0));
  EXPECT_FALSE(outline.kept_at(0.25 * outline.length()));
}

}  // namespace
}  // namespace quadloop
