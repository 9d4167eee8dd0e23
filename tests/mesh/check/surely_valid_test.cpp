// What is_surely_valid() accepts has no fault, and an ordinary valid mesh is accepted.
#include "mesher/mesh/check/surely_valid.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

bool accepts(const Mesh& whole) {
  return is_surely_valid(world(), scatter_mesh(world(), whole, own_order(whole)));
}

Mesh jittered(std::int32_t n, double share = 0.2) {
  const test::Grid grid{n};
  Mesh mesh = grid.mesh();
  test::jitter(grid, share, 3, mesh);
  return mesh;
}

/// Both meshes, with boundaries of both.
Mesh joined(const Mesh& one, Mesh other) {
  Mesh all = one;
  const auto shift = [&](auto& rows) {
    for (auto& nodes : rows) {
      for (NodeId& node : nodes) node = NodeId{node.value() + one.owned_nodes};
    }
  };
  shift(other.triangles);
  shift(other.quads);
  const auto append = [](const auto& more, auto& to) { to.insert(to.end(), more.begin(), more.end()); };
  append(other.points, all.points);
  append(other.triangles, all.triangles);
  append(other.quads, all.quads);
  for (std::size_t b = 0; b < other.boundaries.size(); ++b) {
    shift(other.boundaries[b].edges);
    append(other.boundaries[b].edges, all.boundaries[b].edges);
  }
  all.owned_nodes = size32(all.points);
  return all;
}

Mesh moved(Mesh mesh, Point by, double scale) {
  for (Point& p : mesh.points) p = scale * p + by;
  return mesh;
}

TEST(SurelyValid, AcceptsValidMeshes) {
  for (const std::int32_t n : {1, 2, 7}) EXPECT_TRUE(accepts(jittered(n))) << n;
  const Mesh apart = joined(jittered(5), moved(jittered(4), {3, 0.4}, 0.7));
  ASSERT_TRUE(validate(apart).empty());
  EXPECT_TRUE(accepts(apart));
}

TEST(SurelyValid, RefusesEachFault) {
  const auto expect_refused = [](const char* what, const std::function<void(Mesh&)>& damage) {
    Mesh mesh = jittered(7);
    damage(mesh);
    ASSERT_FALSE(validate(mesh).empty()) << what;
    EXPECT_FALSE(accepts(mesh)) << what;
  };
  expect_refused("node without a cell", [](Mesh& mesh) {
    mesh.points.push_back({0.5, 0.5});
    ++mesh.owned_nodes;
  });
  expect_refused("inverted cell", [](Mesh& mesh) { std::swap(mesh.points[9], mesh.points[10]); });
  expect_refused("missing cell", [](Mesh& mesh) { mesh.quads.pop_back(); });
  expect_refused("missing edge", [](Mesh& mesh) { mesh.boundaries[0].edges.pop_back(); });
  expect_refused("edge twice",
                 [](Mesh& mesh) { mesh.boundaries[0].edges.push_back(mesh.boundaries[0].edges[0]); });
  expect_refused("boundary without edges", [](Mesh& mesh) { mesh.boundaries.push_back({"none", {}, {}}); });
  expect_refused("no cells", [](Mesh& mesh) { mesh = {}; });
  expect_refused("coincident nodes", [](Mesh& mesh) {
    mesh = joined(mesh, moved(jittered(7), {1, 0}, 1));  // two squares side by side, not joined
    for (Point& p : mesh.points) p = {p.x, p.y};
  });
}

TEST(SurelyValid, RefusesCellsUponCells) {
  const Mesh inside = joined(jittered(5), moved(jittered(4), {0.21, 0.23}, 0.5));
  ASSERT_FALSE(validate(inside).empty());
  EXPECT_FALSE(accepts(inside)) << "the inner square's boundary does not meet the outer one's";
  const Mesh across = joined(jittered(5), moved(jittered(4), {0.61, 0.23}, 0.9));
  ASSERT_FALSE(validate(across).empty());
  EXPECT_FALSE(accepts(across));
}

TEST(SurelyValid, AcceptsNoFaultyMeshOfMany) {
  int accepted = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const test::Grid grid{4};
    Mesh mesh = grid.mesh();
    test::jitter(grid, 0.1 + 0.008 * static_cast<double>(seed), seed, mesh);
    const bool valid = validate(mesh).empty(), surely = accepts(mesh);
    EXPECT_TRUE(valid || !surely) << seed;
    accepted += surely ? 1 : 0;
  }
  EXPECT_GT(accepted, 5);
}

}  // namespace
}  // namespace quadloop
