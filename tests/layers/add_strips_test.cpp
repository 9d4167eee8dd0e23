// Meshes with wakes and free lines, whole: valid, filling their outline, the same on any number of ranks.
#include "mesher/layers/add_strips.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "mesher/build/build_mesh.hpp"
#include "mesher/mesh/check/edge_statistics.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/geometry/outlines.hpp"
#include "tests/layers/walls.hpp"
#include "tests/mesh/same_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

const LayerSpec eight_layers{0.005, 1.3, 1.3, 8};

/// A box of 16 by 16 round a body with a sharp nose at the left, of a boundary of its own; at the right it
/// ends in a base of the given height, or sharp too.
Geometry body(double base) {
  test::Side back{"body", {{-1, 0.15}, {0, 0.3}, {2, base / 2}}, eight_layers};
  if (base > 0) back.points.push_back({2, -base / 2});
  back.points.push_back({0, -0.3});
  const test::Side nose{"nose", {{-1, -0.15}, {-2, 0}}, eight_layers};
  return test::outline_of({{{"box", {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}}}, {back, nose}}, 0.4);
}

LayerLine wake(const std::string& from = "body") {
  LayerLine line;
  line.from = {from};
  line.length = 3;
  line.spacing = 0.2;
  return line;
}
LayerLine free_line() {
  LayerLine line;
  line.path = {{-5, -5}, {-3, -5}, {-1, -4.5}};
  line.spacing = 0.2;
  line.layers = eight_layers;
  return line;
}

struct Made {
  Made(const Communicator& comm, const Geometry& geometry, const std::vector<LayerLine>& lines, bool divided,
       double min = 0.02, std::optional<RootOptions> root = {})
      : front{layer_front(geometry, {}, lines)} {
    MeshOptions options;
    options.size.min = min;
    options.size.max = 1;
    options.size.root = root;
    MeshResult outside = build_mesh(comm, front.outer, options);
    mesh = std::move(outside.mesh);
    leaves = std::move(outside.tree.leaves);
    DivideBy divide;
    if (divided) divide = [](Point p) { return tie_rank({0, 0}, p); };
    add_layers(comm, front, outside.edge_leaves, divide, mesh, leaves);
    add_strips(comm, front, outside.edge_leaves, divide, mesh, leaves);
    for (std::size_t b = 0; b < mesh.boundaries.size(); ++b) {
      if (geometry.boundaries()[b].layers)
        mesh.boundaries[b].layers = {eight_layers.count, layers_thickness(eight_layers)};
    }
  }
  LayerFront front;
  Mesh mesh;
  std::vector<LeafRecord> leaves;
};

struct Trial {
  Geometry geometry;
  std::vector<LayerLine> lines;
};
std::vector<Trial> trials() {
  return {
      {body(0), {wake()}}, {body(0.1), {wake()}}, {body(0), {free_line(), wake()}}, {body(0), {free_line()}}};
}

TEST(AddStrips, MeshesAreValidAndFillTheWholeOutline) {
  for (const auto& [geometry, lines] : trials()) {
    for (const bool divided : {false, true}) {
      const Made made(world(), geometry, lines, divided);
      const Mesh whole = gather_whole(world(), made.mesh);
      if (!world().is_root()) continue;
      EXPECT_TRUE(validate(whole).empty());
      double area = 0;
      for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop)
        area += test::loop_area(geometry, loop);
      EXPECT_NEAR(area_of(whole), area, 1e-9 * area);
      EXPECT_EQ(whole.boundaries.size(), geometry.boundaries().size()) << "the strips' own is gone";
    }
  }
}

TEST(AddStrips, MeshesAreTheSameOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  for (const auto& [geometry, lines] : trials()) {
    const Made made(world(), geometry, lines, false), alone(self, geometry, lines, false);
    const Mesh whole = gather_whole(world(), made.mesh), of_one = gather_whole(self, alone.mesh);
    if (world().is_root()) test::expect_same_meshes(whole, of_one);
  }
}

TEST(AddStrips, TheMeshKnowsThemByTheirNames) {
  const std::vector<Trial> all = trials();
  for (const Trial& trial : all) {
    for (const bool divided : {false, true}) {
      const Made made(world(), trial.geometry, trial.lines, divided);
      const std::vector<StripLayers>& strips = made.mesh.strips;
      ASSERT_EQ(strips.size(), trial.lines.size());
      for (std::size_t s = 0; s < strips.size(); ++s) {
        const LayerStrip& strip = made.front.strips[s];
        EXPECT_EQ(strips[s].name, strip.root ? "wake" : "layer_line");
        EXPECT_EQ(strips[s].layers.count, eight_layers.count);
        EXPECT_NEAR(strips[s].layers.thickness, layers_thickness(eight_layers), 1e-15);
        ASSERT_EQ(strips[s].columns(), size32(strip.columns));
        const Mesh whole = gather_whole(world(), made.mesh);
        for (std::int32_t column = 0; world().is_root() && column < strips[s].columns(); ++column) {
          for (std::int32_t row = 0; row < strips[s].across; ++row) {
            const Point p = whole.points[strips[s].node(column, row).value()];
            const double off = length(p - strip.columns[column][row]);
            EXPECT_LE(off, strips[s].is_walls(column, row) ? 1e-14 : 0) << column << ", " << row;
          }
        }
      }
    }
  }
}

TEST(AddStrips, TheirCellsAreThoseOfLayersAndABaseIsTheWalls) {
  for (const auto& [geometry, lines] : trials()) {
    const Made made(world(), geometry, lines, false);
    const LayerPlaces places = layer_places(world(), made.mesh);
    const auto in_strip = [&](const auto& nodes) {
      return is_layer_cell(places, nodes) &&
             std::ranges::any_of(nodes, [&](NodeId node) { return places[node].strip >= 0; });
    };
    const std::int64_t cells = std::ranges::count_if(made.mesh.quads, in_strip) +
                               std::ranges::count_if(made.mesh.triangles, in_strip);
    std::int64_t in_strips = 0, wanted = 0, base_nodes = 0;
    for (const NodeId node : ids_below(NodeId{made.mesh.owned_nodes})) {
      const Point p = made.mesh.point(node);
      in_strips += places[node].strip >= 0 ? 1 : 0;
      base_nodes += places[node].boundary == 1 && p.x == 2 && std::abs(p.y) < 0.049 ? 1 : 0;
    }
    std::int64_t nodes = 0;
    for (const StripLayers& strip : made.mesh.strips) {
      wanted += std::int64_t{strip.columns() - 1} * (strip.across - 1);
      nodes += strip.columns() * std::int64_t{strip.across};
      if (strip.from_wall) nodes -= strip.across - std::max(0, strip.across - 2 - 2 * strip.layers.count);
    }
    const LayerStrip& first = made.front.strips[0];
    const std::int64_t on_base = first.core - 2 * first.base_layers(), layers = first.base_layers();
    if (layers > 0) wanted += on_base + 2 * (layers - 1);  // of the base's cells those at the first column
    EXPECT_EQ(world().sum(cells), wanted);
    EXPECT_EQ(world().sum(in_strips), nodes) << "all but those of the wall's columns";
    if (first.core > 0) {
      EXPECT_EQ(world().sum(base_nodes), on_base - 1) << "the wall's";
    }
  }
}

TEST(AddStrips, WakesTakeAwayTheJumpsOfAreasAtEdges) {
  const Communicator self(MPI_COMM_SELF);
  const auto jump = [&](const std::vector<LayerLine>& lines) {
    return area_ratios(self, gather_whole(self, Made(self, body(0), lines, false).mesh)).largest;
  };
  EXPECT_GT(jump({}), 20);
  EXPECT_LT(jump({wake(), wake("nose")}), 10);
}

TEST(AddStrips, ABaseIsDividedByTheRowsBehindItsLayers) {
  const Made made(world(), body(0.1), {wake()}, false);
  std::int64_t on_base = 0;
  double length_of_base = 0;
  for (const auto& edge : made.mesh.boundaries[1].edges) {
    const Point a = made.mesh.point(edge[0]), b = made.mesh.point(edge[1]);
    if (a.x != 2 || b.x != 2) continue;
    ++on_base;
    length_of_base += a.y - b.y;  // with the domain to its left
  }
  const LayerStrip& strip = made.front.strips[0];
  EXPECT_GE(strip.base_layers(), 1);
  EXPECT_EQ(world().sum(on_base), strip.core - 2 * strip.base_layers());
  const auto lengths = world().all_gather_values(std::span<const double>(&length_of_base, 1));
  EXPECT_NEAR(std::accumulate(lengths.begin(), lengths.end(), 0.0), 0.1, 1e-12);
}

TEST(AddStrips, ABendTooSharpForTheLayersIsRefusedByName) {
  LayerLine bent = free_line();
  bent.path = {{-5, -5}, {-4.13, -5}, {-4.13, -4.28}};
  bent.layers = LayerSpec{0.0072, 1.25, 1.25, 16};
  bent.where = "case.toml:9";
  const std::string message = test::refusal([&] { Made(world(), body(0), {bent}, false); });
  EXPECT_EQ(message.find("case.toml:9: layer_line, near (-"), 0U) << message;
  EXPECT_NE(message.find("gentler bends"), std::string::npos) << message;
}

// Its layers are thinner than a leaf: two corners of its front stand in one, and one of them is lost.
TEST(AddStrips, ALineThinnerThanTheLeavesIsRefusedByName) {
  const Geometry box = test::outline_of({{{"box", {{-5.5, -5.5}, {6.5, -5.5}, {6.5, 6.5}, {-5.5, 6.5}}}},
                                         {{"wall", {{0, 0}, {0, 1}, {1, 1}, {1, 0}}}}},
                                        0.1);
  LayerLine line = free_line();
  line.path = {{-2.8, 3.718}, {2.73, 3.741}};
  line.spacing = 0.05;
  line.layers = {0.0001, 1.3, 1.3, 4};
  const RootOptions root{{-5.5, -5.5}, 12};
  const std::string message = test::refusal([&] { Made(world(), box, {line}, false, 0.003, root); });
  EXPECT_NE(message.find("layer_line: its layers are 0.00124 wide"), std::string::npos) << message;
  EXPECT_NE(message.find("reduce spacing.min"), std::string::npos) << message;
}

TEST(LayerFront, LinesThatMeetSomethingAreRefused) {
  LayerLine through = wake();
  through.length = 20;
  const auto says = [](const std::vector<LayerLine>& lines) {
    return test::refusal([&] { layer_front(body(0), {}, lines); });
  };
  const std::string at_box = says({through});
  EXPECT_NE(at_box.find("the layers of wake, which begins at (2, 0), meet boundary box at (8, "),
            std::string::npos)
      << at_box;
  through.path = {{3, 0.1}, {4, 0.6}, {5, 2}, {5.5, 4}, {5.5, 9}};  // over the box's upper side
  through.length = 0;
  const std::string at_top = says({through});
  EXPECT_NE(at_top.find("meet boundary box at ("), std::string::npos) << at_top;
  EXPECT_NE(at_top.find(", 8), "), std::string::npos) << at_top;
  LayerLine across = free_line();
  across.path = {{3, -1}, {3, 1}};
  EXPECT_NE(says({wake(), across}).find("meet those of"), std::string::npos);
}

TEST(LayerFront, LinesOverABodyOrOutsideTheDomainAreRefused) {
  const Geometry g = test::outline_of({{{"box", {{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}}},
                                       {{"speck", {{-2.99, -5}, {-3, -5.01}, {-3.01, -5}, {-3, -4.99}}}}});
  const auto says = [&](const LayerLine& line) { return test::refusal([&] { layer_front(g, {}, {line}); }); };
  EXPECT_NE(says(free_line()).find("cover boundary speck at (-"), std::string::npos);
  LayerLine outside = free_line();
  for (Point& p : outside.path) p.x -= 10;
  EXPECT_NE(says(outside).find("lies outside of the domain, at (-"), std::string::npos);
  outside.path = {{-3.002, -5}, {-2.998, -5}};
  outside.spacing = 0.001;
  outside.layers = LayerSpec{1e-4, 1.2, 1.2, 3};
  EXPECT_NE(says(outside).find("lies outside of the domain"), std::string::npos) << "within a body";
}

}  // namespace
}  // namespace quadloop
