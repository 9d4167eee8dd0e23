// Images of nodes and cells are found wherever they are, and missed where there are none.
#include "mesher/mesh/mirror_images.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/mirrored_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

Mesh half_above(MirrorAxis axis) {
  const test::Grid grid{6, {2, 1}};
  Mesh half = grid.mesh();
  test::jitter(grid, 0.2, 4, half);
  for (Point& p : half.points) p = axis == MirrorAxis::x ? p : Point{p.y, -p.x};  // a turn by a quarter
  return half;
}

Mesh part_of(const Mesh& whole) { return scatter_mesh(world(), whole, test::shuffled_order(whole, 5)); }

std::string refusal(const Mesh& part, MirrorAxis axis) {
  try {
    require_mirror_images(world(), part, axis);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(MirrorImages, OfNodesAreWhereTheMirrorSays) {
  for (const MirrorAxis axis : {MirrorAxis::x, MirrorAxis::y}) {
    const Mesh part = part_of(test::with_image(half_above(axis), axis));
    const NodeImages images = find_node_images(world(), part, axis);
    const std::vector<Point> points =
        world().all_gather_values(std::span<const Point>(part.points).first(part.owned_nodes));
    ASSERT_EQ(images.size(), part.points.size());
    for (const NodeId node : images.ids())
      EXPECT_EQ(points[images[node].value()], image_of(axis, part.point(node)));
  }
}

TEST(MirrorImages, OfTrianglesHaveTheImagesOfTheirNodes) {
  const MirrorAxis axis = MirrorAxis::x;
  const Mesh part = part_of(test::with_image(half_above(axis), axis));
  const NodeImages images = find_node_images(world(), part, axis);
  const std::vector<Partner> partners = find_triangle_images(world(), part, images, axis);
  using Nodes = std::array<GlobalNodeId, 3>;
  std::vector<Nodes> own;
  for (const auto& t : part.triangles)
    own.push_back({part.global(t[0]), part.global(t[1]), part.global(t[2])});
  const std::vector<Nodes> all = world().all_gather_values(std::span<const Nodes>(own));
  const RankRanges ranges(world(), world().exclusive_sum(std::ssize(own)));
  for (std::size_t i = 0; i < own.size(); ++i) {
    Nodes expected, found = all[ranges.begin(partners[i].rank) + partners[i].item];
    for (std::size_t k = 0; k < 3; ++k) expected[k] = images[part.triangles[i][k]];
    std::ranges::sort(expected);
    std::ranges::sort(found);
    EXPECT_EQ(found, expected);
  }
}

TEST(MirrorImages, AreRequiredOfNodesAndCells) {
  const MirrorAxis axis = MirrorAxis::x;
  const Mesh whole = test::with_image(half_above(axis), axis);
  EXPECT_EQ(refusal(part_of(whole), axis), "");
  EXPECT_NE(refusal(part_of(whole), MirrorAxis::y), "");
  Mesh moved = whole;
  moved.points[10].x += 1e-15;
  EXPECT_NE(refusal(part_of(moved), axis).find("the node at ("), std::string::npos);
  Mesh flipped = whole;
  auto& first = flipped.quads.back();
  flipped.triangles.push_back({first[0], first[1], first[2]});
  flipped.triangles.push_back({first[0], first[2], first[3]});
  flipped.quads.pop_back();
  EXPECT_NE(refusal(part_of(flipped), axis).find("the cell at ("), std::string::npos);
}

TEST(MirrorImages, OfNodesWithoutOneAreNone) {
  const std::vector<Point> all{{0, 0}, {1, 2}, {1, -2}, {3, 1}};
  std::vector<Point> own;
  for (int i = 0; i < 4; ++i) {
    if (i * world().size() / 4 == world().rank()) own.push_back(all[i]);
  }
  const std::int64_t first = world().exclusive_sum(std::ssize(own));
  const std::vector<GlobalNodeId> expected{GlobalNodeId{0}, GlobalNodeId{2}, GlobalNodeId{1}, {}};
  const NodeImages images = node_images(world(), first, own, MirrorAxis::x);
  for (const NodeId node : images.ids()) EXPECT_EQ(images[node], expected[first + node.value()]);
}

}  // namespace
}  // namespace quadloop
