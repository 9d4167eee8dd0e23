// A flow made its own mirror image, where mesh and free stream are.
#include "flow/euler/mirrored_states.hpp"

#include <gtest/gtest.h>

#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/mirrored_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow::euler {
namespace {

using test::world;

TEST(MirroredStates, AreMeansOfNodesAndTheirImages) {
  const Mesh whole = test::with_image(test::Grid{6, {2, 1}}.mesh(), MirrorAxis::x);
  const Mesh mesh = scatter_mesh(world(), whole, test::shuffled_order(whole, 3));
  const DualMesh dual(world(), mesh);
  FlowModel model;
  model.free_stream = {1, 0.8, 0, 1};
  const auto mirrored = MirroredStates::find(world(), dual, model, MirrorAxis::x);
  ASSERT_TRUE(mirrored);
  IdVector<NodeId, State> states(dual.nodes());
  for (const NodeId node : dual.owned_ids()) {
    const auto [x, y] = dual.point(node);
    states[node] = {1 + x + y, x - y * y + y, 0.5 + 2 * y, 3 - y};
  }
  mirrored->average(states);
  for (const NodeId node : dual.owned_ids()) {
    const auto [x, y] = dual.point(node);
    const State expected{1 + x, x - y * y, 2 * y, 3};
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(states[node][k], expected[k], 1e-14);
  }
}

TEST(MirroredStates, AreNoneWhereMeshOrStreamIsNotItsOwnImage) {
  const Mesh whole = test::with_image(test::Grid{6, {2, 1}}.mesh(), MirrorAxis::x);
  Mesh mesh = scatter_mesh(world(), whole, test::shuffled_order(whole, 3));
  FlowModel model;
  model.free_stream = {1, 0.8, 0.01, 1};
  const DualMesh dual(world(), mesh);
  EXPECT_FALSE(MirroredStates::find(world(), dual, model, MirrorAxis::x));
  model.free_stream = {1, 0, 0.8, 1};
  EXPECT_FALSE(MirroredStates::find(world(), dual, model, MirrorAxis::y)) << "the mesh is not";
}

}  // namespace
}  // namespace quadloop::flow::euler
