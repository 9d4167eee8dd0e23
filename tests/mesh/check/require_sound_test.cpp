// What a mesh must obey before it is written, on any number of ranks: each kind of fault ends as a fault of
// the program, with its place.
#include "mesher/mesh/check/require_sound.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "mesher/base/error.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/node.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::node;
using test::world;

Mesh grid() {
  const test::Grid grid{6, {3, 2}};
  Mesh mesh = grid.mesh();
  test::jitter(grid, 0.2, 7, mesh);
  return mesh;
}

/// What is said on this rank of the whole mesh, spread over the ranks.
std::string said_of(const Mesh& whole) {
  try {
    require_sound(world(), scatter_mesh(world(), whole, test::shuffled_order(whole, 3)));
  } catch (const Fault& fault) {
    return fault.what();
  }
  return {};
}

void expect_fault(const std::string& what, const std::function<void(Mesh&)>& spoil) {
  Mesh mesh = grid();
  spoil(mesh);
  const std::string said = said_of(mesh);
  EXPECT_NE(said.find(what), std::string::npos) << what << " in: " << said;
  EXPECT_NE(said.find(" at ("), std::string::npos) << said;
}

TEST(RequireSound, AValidMeshPasses) {
  EXPECT_EQ(said_of(grid()), "");
  Mesh far = grid();
  for (Point& p : far.points) p = p + Point{2e8, -1e9};
  EXPECT_EQ(said_of(far), "");
}

TEST(RequireSound, CornersArePositive) {
  expect_fault("inverted or flat", [](Mesh& m) { std::swap(m.triangles[0][0], m.triangles[0][1]); });
  expect_fault("inverted or flat", [](Mesh& m) { m.points[16] = m.points[24]; });
}

TEST(RequireSound, EdgesHaveACellOrTheBoundaryOnEitherSide) {
  const char* const unmatched = "an edge does not have a cell, or the boundary, on either side";
  expect_fault(unmatched, [](Mesh& m) { m.triangles.pop_back(); });
  expect_fault(unmatched, [](Mesh& m) { m.triangles.push_back(m.triangles[0]); });
  expect_fault(unmatched, [](Mesh& m) { m.boundaries[0].edges.pop_back(); });
  expect_fault(unmatched, [](Mesh& m) { m.boundaries[1].edges.push_back(m.boundaries[1].edges[0]); });
  expect_fault(unmatched,
               [](Mesh& m) { std::swap(m.boundaries[0].edges[0][0], m.boundaries[0].edges[0][1]); });
  expect_fault(unmatched, [](Mesh& m) {  // a crack: the cell gets nodes of its own
    for (NodeId& corner : m.quads[3]) {
      m.points.push_back(m.point(corner));
      ++m.owned_nodes;
      corner = node(size32(m.points) - 1);
    }
  });
}

TEST(RequireSound, AnEdgeOfTheBoundaryHasCellsOnOneSideOnly) {
  expect_fault("an edge of the boundary has cells on both sides", [](Mesh& m) {
    const auto [a, b] = std::pair(m.quads[3][0], m.quads[3][1]);
    m.boundaries[0].edges.push_back({a, b});
    m.boundaries[1].edges.push_back({b, a});
  });
}

/// A copy of a node that lies elsewhere than the owner has it.
TEST(RequireSound, RanksAgreeOnPlaces) {
  const Mesh whole = grid();
  Mesh part = scatter_mesh(world(), whole, test::shuffled_order(whole, 3));
  if (!world().any(!part.ghosts.empty())) return;
  if (world().rank() + 1 == world().size()) {
    ASSERT_FALSE(part.ghosts.empty());
    part.points.back() = part.points.back() + Point{1e-6, 1e-6};
  }
  EXPECT_THROW(require_sound(world(), part), Fault);
}

}  // namespace
}  // namespace quadloop
