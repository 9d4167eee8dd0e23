// Each kind of fault is found where it is, by its own name, and a valid mesh has none.
#include "mesher/mesh/check/validate.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "mesher/mesh/check/block_statistics.hpp"
#include "mesher/mesh/check/edge_statistics.hpp"
#include "mesher/mesh/check/validate_geometry.hpp"
#include "tests/mesh/mixed_square.hpp"
#include "tests/mesh/node.hpp"

namespace quadloop {
namespace {

using test::mixed_square;
using test::node;

/// The outline of mixed_square(), as two chains.
std::vector<Chain> outline() {
  return {{"wall", true, {{0, 0}, {2, 0}, {2, 2}}, ""}, {"far", true, {{2, 2}, {0, 2}, {0, 0}}, ""}};
}

bool has(const std::vector<MeshFault>& faults, MeshRule rule) {
  return std::any_of(faults.begin(), faults.end(),
                     [&](const MeshFault& fault) { return fault.rule == rule; });
}

void expect_fault(MeshRule rule, const std::function<void(Mesh&)>& spoil) {
  Mesh mesh = mixed_square();
  spoil(mesh);
  const std::vector<MeshFault> faults = validate(mesh);
  EXPECT_TRUE(has(faults, rule)) << name_of(rule) << " is missing among " << faults.size() << " faults";
}

TEST(Validate, ValidMeshHasNoFault) {
  for (const MeshFault& fault : validate(mixed_square()))
    ADD_FAILURE() << name_of(fault.rule) << ": " << fault.what;
}

TEST(Validate, Indices) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  expect_fault(MeshRule::indices, [](Mesh& m) { m.triangles[0][1] = node(9); });
  expect_fault(MeshRule::indices, [](Mesh& m) { m.quads[0][1] = NodeId{}; });
  expect_fault(MeshRule::indices, [](Mesh& m) { m.boundaries[0].edges[0][0] = node(77); });
  expect_fault(MeshRule::indices, [](Mesh& m) { m.points[4].x = nan; });
  expect_fault(MeshRule::indices, [](Mesh& m) { m.points.push_back({1, 7}); });
  expect_fault(MeshRule::indices, [](Mesh& m) { m.boundaries.push_back({"none", "none", {}}); });
  EXPECT_TRUE(has(validate(Mesh{}), MeshRule::indices));
}

TEST(Validate, Coincident) {
  expect_fault(MeshRule::coincident,
               [](Mesh& m) {  // a doubled node: the left half keeps node 4, the right half gets its own
                 m.points.push_back(m.points[4]);
                 m.triangles[2][0] = m.triangles[3][0] = m.quads[1][3] = node(9);
               });
}

/// Two squares that touch along x = 1, each with its own nodes there.
TEST(Validate, BothSidesOfACrackAreBoundary) {
  Mesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 0}, {2, 0}, {2, 1}, {1, 1}};
  mesh.owned_nodes = 8;
  mesh.quads = {{node(0), node(1), node(2), node(3)}, {node(4), node(5), node(6), node(7)}};
  mesh.boundaries = {
      {"left", "none", {{node(0), node(1)}, {node(1), node(2)}, {node(2), node(3)}, {node(3), node(0)}}},
      {"right", "none", {{node(4), node(5)}, {node(5), node(6)}, {node(6), node(7)}, {node(7), node(4)}}}};
  for (const MeshFault& fault : validate(mesh)) ADD_FAILURE() << name_of(fault.rule) << ": " << fault.what;
  mesh.points[4].x = mesh.points[7].x = 0.5;  // the cells lie on each other
  EXPECT_TRUE(has(validate(mesh), MeshRule::overlap));
  mesh.points[4] = {1, 0};
  mesh.points[7] = {1, 0.5};  // the sides lie on each other, but their nodes do not
  EXPECT_TRUE(has(validate(mesh), MeshRule::coincident));
  EXPECT_TRUE(has(validate(mesh), MeshRule::overlap));
  mesh.points[7] = {1, 1};
  mesh.boundaries.pop_back();
  EXPECT_TRUE(has(validate(mesh), MeshRule::coincident));
}

TEST(Validate, PairsAreImages) {
  Mesh mesh = test::mixed_square();
  mesh.pairs = {{"wall", "far", {0, 2}}};  // it has corners
  EXPECT_TRUE(has(validate(mesh), MeshRule::pairs));
}

TEST(Validate, Positive) {
  expect_fault(MeshRule::positive, [](Mesh& m) { std::swap(m.triangles[0][0], m.triangles[0][1]); });
  expect_fault(MeshRule::positive, [](Mesh& m) { m.points[4] = {1, 0}; });
  expect_fault(MeshRule::positive, [](Mesh& m) { m.points[1] = {1, 1}; });
  expect_fault(MeshRule::positive, [](Mesh& m) { m.points[4] = {0.2, 0.2}; });  // a quad that is not convex
}

TEST(Validate, Conforming) {
  expect_fault(MeshRule::conforming, [](Mesh& m) { m.boundaries[0].edges.pop_back(); });
  expect_fault(MeshRule::conforming, [](Mesh& m) { m.triangles.pop_back(); });
  expect_fault(MeshRule::conforming, [](Mesh& m) { m.triangles.push_back(m.triangles[0]); });
  expect_fault(MeshRule::conforming, [](Mesh& m) { m.boundaries[0].edges.push_back({node(3), node(4)}); });
  expect_fault(MeshRule::conforming,
               [](Mesh& m) { std::swap(m.boundaries[0].edges[0][0], m.boundaries[0].edges[0][1]); });
}

TEST(Validate, TopologyIsWhatMovingNodesCannotCure) {
  Mesh mesh = mixed_square();
  mesh.points[4] = {5, 5};  // inverted cells, which overlap
  mesh.points[7] = mesh.points[8];
  EXPECT_FALSE(validate(mesh).empty());
  EXPECT_TRUE(validate_topology(mesh).empty());
  mesh.triangles.push_back(mesh.triangles[0]);
  EXPECT_TRUE(has(validate_topology(mesh), MeshRule::conforming));
  mesh = mixed_square();
  mesh.quads[0][2] = node(1);
  const std::vector<MeshFault> faults = validate_topology(mesh);
  ASSERT_TRUE(has(faults, MeshRule::conforming));
  EXPECT_EQ(faults[0].what, "a cell has node 2 twice");
  EXPECT_EQ(faults[0].place, (Point{1, 0}));
}

TEST(Validate, Closed) {
  expect_fault(MeshRule::closed, [](Mesh& m) { m.boundaries[0].edges.push_back(m.boundaries[0].edges[0]); });
}

TEST(Validate, AreaAndOverlap) {
  expect_fault(MeshRule::overlap, [](Mesh& m) {  // the corner folded over the opposite boundary
    m.points[8] = {-1, 1.5};
  });
  expect_fault(MeshRule::area, [](Mesh& m) { m.triangles.push_back(m.triangles[0]); });
}

TEST(Validate, InterfaceNeedsTwoBlocks) {
  Mesh mesh = mixed_square();
  mesh.boundaries.push_back({"interface", "interface", {{node(3), node(4)}, {node(4), node(5)}}});
  EXPECT_TRUE(has(validate(mesh), MeshRule::conforming));
  const std::vector<std::int32_t> of_triangle(4, 1), of_quad(2, 0);
  EXPECT_TRUE(validate(mesh, {2, of_triangle, of_quad}).empty());
}

TEST(Validate, FaultHasItsPlace) {
  Mesh mesh = mixed_square();
  std::swap(mesh.triangles[1][0], mesh.triangles[1][1]);
  const std::vector<MeshFault> faults = validate(mesh);
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults[0].rule, MeshRule::positive);
  EXPECT_EQ(faults[0].place, (Point{1, 2}));
}

TEST(Validate, PinchedNodesAreCountedButAllowed) {
  Mesh mesh;  // two triangles that touch at a node
  mesh.points = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  mesh.owned_nodes = 5;
  mesh.triangles = {{node(0), node(1), node(2)}, {node(0), node(3), node(4)}};
  mesh.boundaries = {{"b",
                      "wall",
                      {{node(0), node(1)},
                       {node(1), node(2)},
                       {node(2), node(0)},
                       {node(0), node(3)},
                       {node(3), node(4)},
                       {node(4), node(0)}}}};
  EXPECT_TRUE(validate(mesh).empty());
}

TEST(ValidateGeometry, FollowsItsOutline) {
  const GeometryFit fit = validate_geometry(mixed_square(), outline());
  EXPECT_TRUE(fit.faults.empty());
  EXPECT_EQ(fit.boundaries_dropped, 0);
  EXPECT_EQ(fit.sharp_corners, 4);  // the ends of the open chains
  EXPECT_EQ(fit.sharp_corners_lost, 0);
  EXPECT_EQ(fit.boundary_node_distance, 0);
  EXPECT_EQ(fit.geometry_distance, 0);
  EXPECT_NEAR(fit.area_error, 0, 1e-15);
}

TEST(ValidateGeometry, FindsWhatIsOff) {
  Mesh moved = mixed_square();
  moved.points[1].y = 0.01;
  const GeometryFit fit = validate_geometry(moved, outline());
  EXPECT_TRUE(has(fit.faults, MeshRule::geometry));
  EXPECT_NEAR(fit.boundary_node_distance, 0.01, 1e-12);
  Mesh renamed = mixed_square();
  renamed.boundaries[0].name = "hull";
  const GeometryFit other = validate_geometry(renamed, outline());
  EXPECT_TRUE(has(other.faults, MeshRule::geometry));
  EXPECT_EQ(other.boundaries_dropped, 1);
}

TEST(ValidateGeometry, CountsLostCornersAndMissingArea) {
  const std::vector<Chain> spiked{{"wall", true, {{0, 0}, {2, 0}, {2, 2}}, ""},
                                  {"far", true, {{2, 2}, {0, 2}, {0, 0}}, ""},
                                  {"hole", false, {{0.4, 0.4}, {0.4, 1.6}, {1.6, 1.6}, {1.6, 0.4}}, ""}};
  const GeometryFit fit = validate_geometry(mixed_square(), spiked);
  EXPECT_EQ(fit.boundaries_dropped, 1);
  EXPECT_EQ(fit.sharp_corners, 8);
  EXPECT_EQ(fit.sharp_corners_lost, 4);
  EXPECT_NEAR(fit.area_error, 1.44 / 2.56, 1e-12);
  EXPECT_TRUE(has(fit.faults, MeshRule::geometry));
  const std::vector<Chain> empty{{"wall", true, {{0, 0}}, ""}, {"far", false, {}, ""}};
  EXPECT_TRUE(has(validate_geometry(mixed_square(), empty).faults, MeshRule::geometry));
}

/// mixed_square() with the triangles in a second block, and the outline of both blocks, the line between them
/// in both directions.
struct TwoBlocks {
  Mesh mesh = mixed_square();
  std::vector<std::int32_t> of_triangle = {1, 1, 1, 1}, of_quad = {0, 0};
  std::vector<Chain> geometry = {{"wall", true, {{0, 0}, {2, 0}, {2, 1}, {2, 2}}, ""},
                                 {"far", true, {{2, 2}, {0, 2}, {0, 1}, {0, 0}}, ""}};

  TwoBlocks() {
    mesh.boundaries.push_back({"middle", {}, {{node(5), node(4)}, {node(4), node(3)}}});
    geometry.push_back({"middle", true, {{0, 1}, {1, 1}, {2, 1}}, ""});
    geometry.push_back({"middle", true, {{2, 1}, {1, 1}, {0, 1}}, ""});
  }
  CellBlocks blocks() const { return {2, of_triangle, of_quad}; }
};

TEST(ValidateGeometry, ComparesTheAreaOfEachBlock) {
  const TwoBlocks two;
  EXPECT_TRUE(validate(two.mesh, two.blocks()).empty());
  const GeometryFit fit = validate_geometry(two.mesh, two.geometry, two.blocks());
  for (const MeshFault& fault : fit.faults) ADD_FAILURE() << fault.what;
  EXPECT_EQ(fit.loops_dropped, 0);
  ASSERT_EQ(fit.block_area_errors.size(), 2U);
  for (const double error : fit.block_area_errors) EXPECT_NEAR(error, 0, 1e-15);

  TwoBlocks moved;  // the whole area is right
  for (const std::int32_t i : {3, 4, 5}) moved.mesh.points[i].y = 0.8;
  const GeometryFit other = validate_geometry(moved.mesh, moved.geometry, moved.blocks());
  EXPECT_NEAR(other.area_error, 0, 1e-15);
  ASSERT_EQ(other.block_area_errors.size(), 2U);
  EXPECT_NEAR(other.block_area_errors[0], 0.25, 1e-12);
  EXPECT_NEAR(other.block_area_errors[1], 0.4 / 2.4, 1e-12);
}

TEST(ValidateGeometry, AChainOfOneEdgeBetweenOthersIsInTheMesh) {
  TwoBlocks two;
  two.geometry[0].points = {{0, 0}, {2, 0}};
  two.geometry.push_back({"wall", true, {{2, 1}, {2, 2}}, ""});
  two.geometry.push_back({"wall", true, {{2, 0}, {2, 1}}, ""});  // its ends belong to the others
  const GeometryFit fit = validate_geometry(two.mesh, two.geometry, two.blocks());
  for (const MeshFault& fault : fit.faults) ADD_FAILURE() << fault.what;
  EXPECT_EQ(fit.loops_dropped, 0);
  for (const double error : fit.block_area_errors) EXPECT_NEAR(error, 0, 1e-15);
}

TEST(ValidateGeometry, AnInterfaceHasCellsOnBothSides) {
  TwoBlocks two;
  two.mesh.triangles.clear();
  two.of_triangle.clear();
  two.mesh.points.resize(6);
  two.mesh.owned_nodes = 6;
  two.mesh.boundaries = {{"wall", "wall", {{node(0), node(1)}, {node(1), node(2)}, {node(2), node(5)}}},
                         {"far", "farfield", {{node(3), node(0)}}},
                         {"middle", {}, {{node(5), node(4)}, {node(4), node(3)}}}};
  const GeometryFit fit = validate_geometry(two.mesh, two.geometry, two.blocks());
  EXPECT_TRUE(std::ranges::any_of(fit.faults, [](const MeshFault& fault) {
    return fault.what.find("boundary middle has cells on one side only") != std::string::npos;
  }));
}

TEST(BlockStatistics, CountsCellsAreaAndInterfaceEdges) {
  TwoBlocks two;
  const std::vector<std::string> names{"below", "above"};
  const Communicator alone(MPI_COMM_SELF);
  const auto sizes = block_statistics(alone, two.mesh, two.blocks(), names);
  ASSERT_EQ(sizes.size(), 2U);
  EXPECT_EQ(sizes[0].name, "below");
  EXPECT_EQ(sizes[0].cells, 2);
  EXPECT_EQ(sizes[1].cells, 4);
  EXPECT_EQ(sizes[1].area, 2);
  const HaloMesh halo(alone, two.mesh);
  const std::int64_t between = edge_statistics(alone, two.mesh, halo, two.blocks()).between_blocks;
  EXPECT_EQ(between, 2);
  InterfaceEdges edges = interface_edges(alone, two.mesh, between);
  EXPECT_EQ(edges.unnamed, 0);
  two.mesh.boundaries.back().edges.pop_back();
  edges = interface_edges(alone, two.mesh, between);
  EXPECT_EQ(edges.unnamed, 1);
}

}  // namespace
}  // namespace quadloop
