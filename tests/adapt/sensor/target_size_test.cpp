// Flags from a field of target edge lengths.
#include "adapt/sensor/target_size.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesher/base/error.hpp"
#include "tests/adapt/sensor/shared_leaves.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::field_of;
using test::world;
using RefinementFlags = std::vector<RefinementFlag>;

TEST(TargetSize, LevelIsThatOfTheLargestLeafThatIsSmallEnough) {
  EXPECT_EQ(level_for_size(8, 100), 0);
  EXPECT_EQ(level_for_size(8, 8), 0);
  EXPECT_EQ(level_for_size(8, std::nextafter(8, 0)), 1);
  EXPECT_EQ(level_for_size(8, 1), 3);
  EXPECT_EQ(level_for_size(8, 0.9), 4);
  EXPECT_EQ(level_for_size(8, 1e-300), 30);
}

TEST(TargetSize, OfALeafIsTheSmallestOfItsNodes) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    const std::vector<LeafRecord> leaves = test::leaves_of(pieces.whole, 4);
    const auto size = [](std::int64_t node, Point) { return 2 + test::scattered(6, node, 0); };
    std::vector<double> expected;
    std::size_t triangle = 0, quad = 0;
    for (const LeafRecord& leaf : leaves) {
      double smallest = 3;
      const auto lower = [&](const auto& nodes) {
        for (const NodeId node : nodes) smallest = std::min(smallest, size(node.value(), {}));
      };
      for (std::int32_t k = 0; k < leaf.triangles; ++k) lower(pieces.whole.triangles[triangle++]);
      for (std::int32_t k = 0; k < leaf.quads; ++k) lower(pieces.whole.quads[quad++]);
      expected.push_back(leaf.triangles + leaf.quads > 0 ? smallest : 0);
    }
    for (const test::Sharing sharing : test::all_sharings) {
      const std::vector<LeafRecord> own = test::share_of(leaves, sharing);
      EXPECT_EQ(leaf_sizes(world(), pieces.part, own, field_of(pieces.part, "h", size)),
                test::share_of(expected, sharing));
    }
  });
}

TEST(TargetSize, RefusesSizesThatNoLeafCanHave) {
  const Mesh mesh = test::Grid{2}.mesh(), part = test::Pieces(mesh, own_order(mesh)).part;
  const std::vector<LeafRecord> own = test::share_of(test::leaves_of(mesh, 1), test::Sharing::even);
  for (const double bad : {0.0, -1.0}) {
    const Field field = field_of(part, "h", [&](std::int64_t node, Point) { return node == 7 ? bad : 1; });
    try {
      leaf_sizes(world(), part, own, field);
      FAIL() << "nothing was refused";
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).rfind("variable 'h': node 8 at (0.5, 1)", 0), 0U) << error.what();
    }
  }
}

TEST(TargetSize, MarksLeavesThatAreTooLargeOrTwiceTooSmall) {
  TreeRecord all;
  all.attributes.tree_edge = 8;  // a leaf of level 3 has edge 1
  const std::vector<double> sizes{0.99, 1, 1.99, 2, 100, 0, 1e-9};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    all.leaves.push_back(i == 5 ? LeafRecord{} : test::leaf_with(1, 1));
    all.leaves.back().level = 3;
  }
  TreeRecord own{all.attributes, test::share_of(all.leaves, test::Sharing::uneven)};
  const RefinementFlags flags = mark_by_size(own, test::share_of(sizes, test::Sharing::uneven));
  const RefinementFlags expected{RefinementFlag::refine,  RefinementFlag::keep,    RefinementFlag::keep,
                                 RefinementFlag::coarsen, RefinementFlag::coarsen, RefinementFlag::keep,
                                 RefinementFlag::refine};
  EXPECT_EQ(test::joined(world(), flags), expected);
}

}  // namespace
}  // namespace quadloop::adapt
