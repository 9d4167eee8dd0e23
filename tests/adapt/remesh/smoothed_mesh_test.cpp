// What may pass for a mesh that was smoothed, and what may not. On one rank alone.
#include "adapt/remesh/smoothed_mesh.hpp"

#include <gtest/gtest.h>

#include "adapt/remesh/tree_mesh.hpp"
#include "mesher/base/error.hpp"
#include "smoother/smooth_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"

namespace quadloop {
namespace {

constexpr test::Grid grid{8, {1, 1}, true};

Mesh jittered() {
  Mesh mesh = grid.mesh();
  jitter(grid, 0.2, 3, mesh);
  return mesh;
}

const Communicator& self() {
  static const auto* const comm = new Communicator(MPI_COMM_SELF);
  return *comm;
}

Mesh smoothed(Mesh mesh, bool inner_nodes_alone) {
  SmoothOptions options;
  options.sweeps = 5;
  const Mesh before = mesh;
  smooth_mesh(self(), mesh, options);
  for (std::int32_t node = 0; inner_nodes_alone && node < mesh.owned_nodes; ++node) {
    if (!grid.inner(node)) mesh.points.begin()[node] = before.point(NodeId{node});
  }
  return mesh;
}

/// The unit square.
Geometry outline() {
  return {{{"wall", 0, 30, "wall"}, {"far", 0, 30, "farfield"}},
          {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
          {0, 4},
          {BoundaryId{0}, BoundaryId{0}, BoundaryId{1}, BoundaryId{1}}};
}

TEST(SmoothedMesh, ItselfAndItsSmoothedPass) {
  const Mesh before = jittered();
  const Geometry square = outline();
  EXPECT_EQ(fault_of_smoothed(before, before, nullptr), "");
  EXPECT_EQ(fault_of_smoothed(before, smoothed(before, false), &square), "");
}

TEST(SmoothedMesh, WithoutAnOutlineBoundaryNodesMustStay) {
  const Mesh before = jittered();
  EXPECT_NE(fault_of_smoothed(before, smoothed(before, false), nullptr).find("lies off its outline"),
            std::string::npos);
}

TEST(SmoothedMesh, CellsInAnotherOrderPass) {
  const Mesh before = jittered();
  Mesh found = before;
  std::reverse(found.triangles.begin(), found.triangles.end());
  EXPECT_EQ(fault_of_smoothed(before, found, nullptr), "");
}

/// Of two opposite ways one is for the worse, at least.
TEST(SmoothedMesh, ANodeMovedForTheWorseIsFound) {
  const Mesh before = grid.mesh();
  for (std::int32_t node = 0; node < before.owned_nodes; ++node) {
    if (!grid.inner(node)) continue;
    bool found_worse = false;
    for (const double way : {0.01, -0.01}) {
      Mesh found = before;
      found.points.begin()[node].x += way;
      const std::string fault = fault_of_smoothed(before, found, nullptr);
      found_worse = found_worse || fault.find("are worse than they were") != std::string::npos;
    }
    EXPECT_TRUE(found_worse) << node;
  }
}

TEST(SmoothedMesh, AnInvertedCellIsInvalid) {
  const Mesh before = grid.mesh();
  Mesh found = before;
  for (std::int32_t node = 0; node < found.owned_nodes; ++node) {
    if (!grid.inner(node)) continue;
    found.points.begin()[node].x += 0.4;
    break;
  }
  EXPECT_TRUE(fault_of_smoothed(before, found, nullptr).starts_with("it is invalid: "));
}

TEST(SmoothedMesh, AnotherMeshIsNone) {
  const Mesh before = jittered();
  Mesh found = before;
  found.points.push_back({3, 3});
  EXPECT_EQ(fault_of_smoothed(before, found, nullptr), "it has another number of nodes");
  found = before;
  ASSERT_FALSE(before.quads.empty());
  const auto [a, b, c, d] = found.quads.back();
  found.quads.pop_back();
  found.triangles.push_back({a, b, c});
  found.triangles.push_back({a, c, d});
  EXPECT_EQ(fault_of_smoothed(before, found, nullptr), "its cells are others");
}

TEST(SettleMesh, TheTreesOwnNodesTakeThePlaceOfRoundedOnes) {
  TreeMesh known{true, jittered(), nullptr};
  Mesh rounded = known.whole;
  for (Point& p : rounded.points) p.x += 1e-9;
  settle_mesh(known, rounded, "file.vtu");
  EXPECT_EQ(rounded.points, known.whole.points);
}

TEST(SettleMesh, SmoothedNodesStayAndOthersAreRefused) {
  const Geometry square = outline();
  TreeMesh known{true, jittered(), &square};
  Mesh found = smoothed(known.whole, true);
  const auto points = found.points;
  settle_mesh(known, found, "file.vtu");
  EXPECT_EQ(found.points, points);
  found.points.begin()->x -= 0.01;
  try {
    settle_mesh(known, found, "file.vtu");
    FAIL();
  } catch (const InputError& fault) {
    EXPECT_TRUE(std::string(fault.what()).starts_with("file.vtu: ")) << fault.what();
  }
}

TEST(SettleMesh, WhereTheTreesMeshIsNotKnownCellsMustBeValid) {
  Mesh found = jittered();
  EXPECT_NO_THROW(settle_mesh({}, found, "file.vtu"));
  found.boundaries.clear();
  EXPECT_NO_THROW(settle_mesh({}, found, "file.vtu")) << "names of boundaries do not matter";
  std::swap(found.triangles.front()[0], found.triangles.front()[1]);
  EXPECT_THROW(settle_mesh({}, found, "file.vtu"), InputError);
}

}  // namespace
}  // namespace quadloop
