// Meshing and smoothing in one, and the numbers that tell meshes and cases apart.
#include "generate/generate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <set>

#include "generate/digests.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/check/delaunay_check.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// A box round a disc of void.
MeshInput disc_in_box(const std::optional<LayerSpec>& layers = {}) {
  std::vector<Point> points{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  std::vector<BoundaryId> boundary(4, BoundaryId{0});
  for (int i = 0; i < 60; ++i) {
    const double angle = -2 * std::numbers::pi * i / 60;
    points.push_back({0.1 + 0.4 * std::cos(angle), 0.05 + 0.4 * std::sin(angle)});
    boundary.push_back(BoundaryId{1});
  }
  std::vector<Boundary> boundaries{{"box", 0.25, 30, "none"}, {"disc", 0.06, 30, "wall"}};
  boundaries[1].layers = layers;
  MeshInput input{{boundaries, points, {0, 4, 64}, boundary}, {}, {}, 0};
  input.mesh.size.min = 0.03;
  input.mesh.size.max = 0.25;
  input.smooth.sweeps = 5;
  input.digest = case_digest(input.mesh);
  return input;
}

TEST(Generate, SmoothsWhatItHasMeshed) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshInput input = disc_in_box();
    input.mesh.type = type;
    const MeshResult unsmoothed = build_mesh(world(), input.geometry, input.mesh);
    const GeneratedMesh made = generate_mesh(world(), input);
    const QualitySummary before = summarise_quality(world(), unsmoothed.mesh);
    const QualitySummary after = summarise_quality(world(), made.result.mesh);
    EXPECT_GT(after.smallest_degrees, before.smallest_degrees);
    EXPECT_EQ(after.counts.nodes, before.counts.nodes);
    EXPECT_EQ(std::prev(made.times.stages().end(), 2)->first, "smooth");
    EXPECT_EQ(made.times.stages().back().first, "check");
    EXPECT_EQ(made.times.stages().size(), made.result.report.times.stages().size() + 2);
    EXPECT_EQ(made.result.tree.attributes.coordinate_digest, coordinate_digest(world(), made.result.mesh));
    EXPECT_EQ(made.result.tree.attributes.case_digest, input.digest);
    std::int64_t of_leaves = 0;
    for (const LeafRecord& leaf : made.result.tree.leaves) of_leaves += leaf.triangles;
    EXPECT_EQ(world().sum(of_leaves), made.result.tree.attributes.triangles) << "flips are counted";
    const Mesh whole = gather_whole(world(), made.result.mesh);
    if (!world().is_root()) continue;
    EXPECT_TRUE(validate(whole).empty());
    EXPECT_EQ(is_delaunay(whole), type == MeshType::delaunay);
  }
}

TEST(Generate, LayersAreDividedInDelaunayMeshesOnly) {
  constexpr LayerSpec five_layers{0.005, 1.2, 1.2, 5};
  for (const MeshType type : {MeshType::hybrid, MeshType::metric, MeshType::delaunay}) {
    MeshInput input = disc_in_box(five_layers);
    input.mesh.type = type;
    const Mesh whole = gather_whole(world(), generate_mesh(world(), input).result.mesh);
    if (!world().is_root()) continue;
    EXPECT_TRUE(validate(whole).empty());
    const std::size_t columns = whole.boundaries[1].edges.size();
    ASSERT_GT(columns, 20U);
    if (type == MeshType::hybrid)
      EXPECT_GT(whole.quads.size(), 5 * columns);
    else
      EXPECT_EQ(whole.quads.size(), type == MeshType::metric ? 5 * columns : 0);
  }
}

TEST(Generate, WithoutSweepsTheMeshIsAsItWasCut) {
  MeshInput input = disc_in_box();
  input.smooth.sweeps = 0;
  EXPECT_EQ(generate_mesh(world(), input).result.mesh.points,
            build_mesh(world(), input.geometry, input.mesh).mesh.points);
}

/// Points away from the disc and from each other, one on grid lines, and a corner.
std::vector<RequiredPoint> required_points() {
  std::vector<RequiredPoint> points;
  for (const Point p :
       {Point{0.75, -0.5}, Point{-0.61, 0.13}, Point{0.1, 0.71}, Point{-0.5, -0.5}, Point{1, 1}})
    points.push_back({"p" + std::to_string(points.size()), p, "case"});
  return points;
}

/// Expects each point exactly at the node of its name in a mesh of each type, the same as on one rank.
void expect_named_nodes(MeshInput input) {
  input.mesh.required_points = required_points();
  const Communicator self(MPI_COMM_SELF);
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    for (const QuadChoice quads : {QuadChoice::all, QuadChoice::parallel}) {
      input.mesh.type = type;
      input.mesh.quads = quads;
      const Mesh whole = gather_whole(world(), generate_mesh(world(), input).result.mesh);
      const Mesh alone = generate_mesh(self, input).result.mesh;
      if (!world().is_root()) continue;
      EXPECT_EQ(whole.points, alone.points);
      EXPECT_EQ(whole.triangles, alone.triangles);
      EXPECT_EQ(whole.quads, alone.quads);
      EXPECT_EQ(whole.named_nodes, alone.named_nodes);
      EXPECT_TRUE(validate(whole).empty());
      ASSERT_EQ(whole.named_nodes.size(), input.mesh.required_points.size());
      for (std::size_t i = 0; i < whole.named_nodes.size(); ++i) {
        const auto& [name, position, where] = input.mesh.required_points[i];
        EXPECT_EQ(whole.named_nodes[i].name, name);
        EXPECT_EQ(whole.points[whole.named_nodes[i].node.value()], position);
      }
    }
  }
}

TEST(Generate, SinglePointsStayNodesInSmoothing) {
  MeshInput input = disc_in_box();
  input.smooth.sweeps = 20;
  expect_named_nodes(input);
}

TEST(Generate, SinglePointsAreNodesOutsideLayers) {
  MeshInput input = disc_in_box();
  std::vector<Boundary> boundaries(input.geometry.boundaries().begin(), input.geometry.boundaries().end());
  boundaries[1].layers = LayerSpec{0.01, 1.2, 1.2, 5};
  GeometryBuilder builder;
  for (std::int32_t loop = 0; loop < input.geometry.loop_count(); ++loop)
    builder.add_loop(input.geometry, loop);
  input.geometry = std::move(builder).geometry(boundaries);
  expect_named_nodes(input);
  input.mesh.required_points = {{"inner", {0.53, 0.05}, "case"}};
  try {
    generate_mesh(world(), input);
    ADD_FAILURE() << "a point in layers is accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "case: point 'inner' at (0.53, 0.05) lies in boundary layers, whose nodes follow from the wall; move "
        "it out of them, or make the layers thinner");
  }
}

TEST(Generate, WhatSmoothingKeepsFollowsFromTheCase) {
  MeshInput input = disc_in_box();
  EXPECT_EQ(smooth_options_for(input, 6).geometry, &input.geometry);
  EXPECT_TRUE(smooth_options_for(input, 6).level_transitions);
  EXPECT_FALSE(smooth_options_for(input, 6).delaunay);
  input.mesh.quads = QuadChoice::parallel;
  EXPECT_FALSE(smooth_options_for(input, 6).level_transitions);
  input.mesh.type = MeshType::delaunay;  // it has no quads to spare
  EXPECT_TRUE(smooth_options_for(input, 6).level_transitions);
  EXPECT_TRUE(smooth_options_for(input, 6).delaunay);
}

TEST(Generate, QuadsThatAreSkewAfterSmoothingAreDivided) {
  MeshInput input = disc_in_box();
  input.mesh.quads = QuadChoice::parallel;
  const MeshResult made = generate_mesh(world(), input).result;
  for (const auto& quad : made.mesh.quads) {
    std::array<Point, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = made.mesh.point(quad[k]);
    EXPECT_LE(skew_of(corners), parallel_skew);
  }
  EXPECT_GT(made.tree.attributes.quads, 0);
  EXPECT_EQ(made.tree.attributes.quads, world().sum(std::ssize(made.mesh.quads)));
}

TEST(Generate, IsTheSameOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshInput input = disc_in_box();
    input.mesh.type = type;
    EXPECT_EQ(generate_mesh(world(), input).result.tree.attributes.coordinate_digest,
              generate_mesh(self, input).result.tree.attributes.coordinate_digest);
  }
}

/// The disc with layers that end 0.1 from it.
MeshInput layered_disc() {
  MeshInput input = disc_in_box();
  const Geometry& g = input.geometry;
  std::vector<Boundary> boundaries(g.boundaries().begin(), g.boundaries().end());
  boundaries[1].layers = LayerSpec{0.005, 1.2, 1.2, 9};
  std::vector<BoundaryId> of_segment;
  for (std::int32_t s = 0; s < g.size(); ++s) of_segment.push_back(g.boundary_of(s));
  input.geometry = {boundaries, {g.points().begin(), g.points().end()}, {0, 4, 64}, of_segment};
  return input;
}

TEST(Generate, LayersStandOnTheWallsThatAskForThem) {
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshInput input = layered_disc();
    input.mesh.type = type;
    const GeneratedMesh made = generate_mesh(world(), input);
    const TreeAttributes& a = made.result.tree.attributes;
    EXPECT_EQ(a.geometry_digest, input.geometry.digest()) << "that of the walls, not of the front";
    EXPECT_EQ(a.coordinate_digest, coordinate_digest(world(), made.result.mesh));
    EXPECT_EQ(a.nodes, world().sum(made.result.mesh.owned_nodes));
    EXPECT_EQ(a.triangles, world().sum(std::ssize(made.result.mesh.triangles)));
    EXPECT_EQ(a.quads, world().sum(std::ssize(made.result.mesh.quads)));
    EXPECT_EQ(made.times.stages().front().first, "layer edge");
    EXPECT_EQ(std::prev(made.times.stages().end(), 2)->first, "layers");
    const Mesh whole = gather_whole(world(), made.result.mesh);
    if (!world().is_root()) continue;
    EXPECT_TRUE(validate(whole).empty());
    EXPECT_EQ(whole.quads.empty(), type == MeshType::delaunay);
    EXPECT_NEAR(area_of(whole), 4 - std::numbers::pi * 0.16, 0.005);
    std::set<NodeId> on_wall;
    for (const auto& edge : whole.boundaries[1].edges) on_wall.insert(edge.begin(), edge.end());
    std::size_t next = 0;
    for (const Point p : whole.points) next += std::abs(length(p - Point{0.1, 0.05}) - 0.405) < 1e-3 ? 1 : 0;
    EXPECT_EQ(next, on_wall.size()) << "nodes at the first layer's height";
  }
}

TEST(Generate, StripsOfAbsurdSizeAreRefusedBeforeTheyAreBuilt) {
  MeshInput input = layered_disc();
  input.lines = {{{}, {{-0.9, -0.9}, {0.9, -0.9}}, 0, 1e-12, LayerSpec{1e-3, 1.2, 1.2, 5}, "case.toml:7"}};
  const auto says = [&] {
    try {
      generate_mesh(world(), input);
    } catch (const TooManyCells& error) {
      return std::string(error.what());
    }
    return std::string("no refusal");
  };
  EXPECT_EQ(says().find("case.toml:7: the layers of layer_line would have at least 1.8e+13 cells"), 0U)
      << says();
  input.lines[0].spacing = 0.01;
  input.mesh.limit.cells = 1700;
  EXPECT_NE(says().find("but --max-cells allows 1700"), std::string::npos) << says();
  input.mesh.limit = {MeshLimit::none, 1e4, 1};
  EXPECT_EQ(says().find("case.toml:7: the layers of layer_line"), 0U) << says();
  EXPECT_NE(says().find("are free"), std::string::npos) << says();
}

TEST(Generate, AWakeMayTakeAWholeBoundaryForItsBase) {
  MeshInput input = layered_disc();
  Boundary upper{"upper", 0.1, 30, "wall"}, base = upper, lower = upper, box{"box", 0.5, 30, "none"};
  base.name = "base";
  lower.name = "lower";
  upper.layers = base.layers = lower.layers = LayerSpec{0.005, 1.3, 1.3, 4};
  const std::vector<Point> points{{-4, -4},  {4, -4},   {4, 4},     {-4, 4},    {-1, 0.2},
                                  {0, 0.25}, {1, 0.03}, {1, -0.03}, {0, -0.25}, {-1, -0.2}};
  std::vector<BoundaryId> of_segment(4, BoundaryId{0});
  for (const int b : {1, 1, 2, 3, 3, 1}) of_segment.emplace_back(b);
  input.geometry = Geometry({box, upper, base, lower}, points, {0, 4, 10}, of_segment);
  input.mesh.size.min = 0.01;
  input.mesh.size.max = 0.5;
  input.lines = {{{"upper", "base", "lower"}, {}, 1.5, 0.1, {}}};
  const GeneratedMesh made = generate_mesh(world(), input);
  EXPECT_TRUE(made.result.report.boundaries_vanished.empty());
  const Mesh whole = gather_whole(world(), made.result.mesh);
  if (!world().is_root()) return;
  EXPECT_TRUE(validate(whole).empty());
  ASSERT_EQ(whole.strips.size(), 1U);
  double length_of_base = 0;
  for (const auto& [from, to] : whole.boundaries[2].edges)
    length_of_base += length(whole.point(to) - whole.point(from));
  EXPECT_NEAR(length_of_base, 0.06, 1e-12);
}

TEST(Generate, LayersAreTheSameOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshInput input = layered_disc();
    input.mesh.type = type;
    EXPECT_EQ(generate_mesh(world(), input).result.tree.attributes.coordinate_digest,
              generate_mesh(self, input).result.tree.attributes.coordinate_digest);
  }
}

TEST(Digests, ChangeWithEverySetting) {
  std::set<std::uint64_t> seen;
  const auto see = [&](const std::function<void(MeshOptions&)>& change) {
    MeshOptions options = disc_in_box().mesh;
    change(options);
    EXPECT_TRUE(seen.insert(case_digest(options)).second) << seen.size();
  };
  see([](MeshOptions&) {});
  see([](MeshOptions& o) { o.type = MeshType::delaunay; });
  see([](MeshOptions& o) { o.quads = QuadChoice::parallel; });
  see([](MeshOptions& o) { o.size.min *= 2; });
  see([](MeshOptions& o) { o.size.max *= 2; });
  see([](MeshOptions& o) { o.size.gradation = 2; });
  see([](MeshOptions& o) { o.size.curvature = 0; });
  see([](MeshOptions& o) { o.size.gap = 0; });
  see([](MeshOptions& o) { o.snap = 0.3; });
  see([](MeshOptions& o) { o.size.root = RootOptions{{0, 0}, 1, 1, 2}; });
  see([](MeshOptions& o) { o.size.root = RootOptions{{0, 0}, 1, 2, 1}; });
  see([](MeshOptions& o) { o.size.sources = {{Box{{0, 0}, {1, 1}}, 1}}; });
  see([](MeshOptions& o) { o.size.sources = {{SizeSource::Line{{0, 0}, {1, 1}}, 1}}; });
  see([](MeshOptions& o) { o.size.sources = {{SizeSource::Disc{{0, 0}, 1}, 1}}; });
  see([](MeshOptions& o) { o.size.sources = {{Box{{0, 0}, {1, 1}}, 1}, {Box{{0, 0}, {1, 1}}, 1}}; });
}

TEST(Digests, DoNotChangeWithWhatTheMeshDoesNotDependOn) {
  MeshOptions options = disc_in_box().mesh, other = options;
  other.limit.cells = 1e9;
  other.size.sources = options.size.sources = {{Box{{0, 0}, {1, 1}}, 1, "a"}};
  other.size.sources[0].where = "b";
  EXPECT_EQ(case_digest(options), case_digest(other));
}

TEST(Digests, OfCoordinatesTellOrderAndBitsButNotTheSignOfZero) {
  Mesh mesh;
  for (const Point p : {Point{0, 1}, Point{2, 3}}) mesh.points.push_back(p);
  mesh.owned_nodes = 2;
  Mesh swapped = mesh, signed_zero = mesh, nudged = mesh;
  std::swap(swapped.points.begin()[0], swapped.points.begin()[1]);
  signed_zero.points.begin()->x = -0.0;
  nudged.points.begin()->y = std::nextafter(1.0, 2.0);
  EXPECT_NE(digest_of_owned(mesh), digest_of_owned(swapped));
  EXPECT_EQ(digest_of_owned(mesh), digest_of_owned(signed_zero));
  EXPECT_NE(digest_of_owned(mesh), digest_of_owned(nudged));
}

TEST(Digests, OfTextsTellLengths) {
  EXPECT_EQ(text_digest("abc"), text_digest("abc"));
  EXPECT_NE(text_digest(""), text_digest(std::string(1, '\0')));
  EXPECT_NE(text_digest("ab"), text_digest("ba"));
}

/// The disc as an island with a zigzag coast, on leaves too large for it, with layers on it.
MeshInput rough_island() {
  std::vector<Point> points{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  std::vector<BoundaryId> boundary(4, BoundaryId{0});
  for (int i = 0; i < 240; ++i) {
    const double angle = -2 * std::numbers::pi * i / 240, radius = 0.4 + (i % 2 + i % 5) * 0.02;
    points.push_back({0.1 + radius * std::cos(angle), 0.05 + radius * std::sin(angle)});
    boundary.push_back(BoundaryId{1});
  }
  Boundary coast{"coast", 0, 180, "wall"};
  coast.layers = LayerSpec{0.002, 1.2, 1.2, 8};
  MeshInput input{{{{"box", 0.25, 30, "none"}, coast}, points, {0, 4, 244}, boundary}, {}, {}, 0};
  input.mesh.size.min = 0.05;
  input.mesh.size.max = 0.25;
  input.smooth.sweeps = 5;
  return input;
}

TEST(Generate, LayersOnARoughCoastGetTheLeavesThatTheyNeed) {
  const Communicator self(MPI_COMM_SELF);
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshInput input = rough_island();
    input.mesh.type = type;
    const GeneratedMesh made = generate_mesh(world(), input), alone = generate_mesh(self, input);
    EXPECT_EQ(made.times.stages()[1].first, "trials") << "the first mesh outside is too coarse";
    EXPECT_EQ(made.result.tree.attributes.coordinate_digest, alone.result.tree.attributes.coordinate_digest);
    for (const LeafRecord& leaf : made.result.tree.leaves)
      EXPECT_EQ(leaf.adapted, 0U) << "adaptation has asked for nothing";
    const Mesh whole = gather_whole(world(), made.result.mesh);
    if (!world().is_root()) continue;
    EXPECT_TRUE(validate(whole).empty());
  }
}

TEST(Generate, IslandsTooSmallForALeafGetNoLayers) {
  MeshInput input = rough_island();
  std::vector<Boundary> boundaries(input.geometry.boundaries().begin(), input.geometry.boundaries().end());
  boundaries.push_back(boundaries.back());
  boundaries.back().name = "rock";
  std::vector<Point> points(input.geometry.points().begin(), input.geometry.points().end());
  points.insert(points.end(), {{-0.7, -0.7}, {-0.69, -0.69}, {-0.68, -0.7}});
  std::vector<BoundaryId> of_segment(4, BoundaryId{0});
  of_segment.resize(244, BoundaryId{1});
  of_segment.resize(247, BoundaryId{2});
  input.geometry = Geometry(boundaries, points, {0, 4, 244, 247}, of_segment);
  input.mesh.may_vanish = true;
  const GeneratedMesh made = generate_mesh(world(), input);
  EXPECT_EQ(made.result.report.islands_dropped, 1);
  EXPECT_EQ(made.result.report.boundaries_vanished, std::vector<std::string>{"rock"});
  EXPECT_EQ(made.layers.size(), 1U);
  input.mesh.may_vanish = false;
  EXPECT_THROW(generate_mesh(world(), input), InputError);
}

}  // namespace
}  // namespace quadloop
