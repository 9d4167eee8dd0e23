// A mesh that is its own mirror image is one after smoothing, to the last bit, on any number of ranks.
#include "smoother/smooth_mirrored.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"
#include "mesher/delaunay/restore/restore_delaunay.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/mirror_images.hpp"
#include "tests/delaunay/rank_of.hpp"
#include "tests/mesh/mirrored_mesh.hpp"
#include "tests/smoother/whole_meshes.hpp"

namespace quadloop::smoother {
namespace {

using test::Grid;
using test::rank_of;
using test::self;

Mesh mirrored_mesh(bool quads, double share = 0.24) {
  Mesh half = test::jittered(Grid{10, {2, 1}, quads}, share);
  if (!quads) restore_delaunay(self(), half, NodeFlags(half.points.size(), 1), rank_of);
  return test::with_image(half, MirrorAxis::x);
}

SmoothOptions options_for(bool quads) {
  SmoothOptions options;
  options.mirror = MirrorAxis::x;
  if (!quads) options.delaunay = rank_of;
  return options;
}

TEST(SmoothMirrored, KeepsTheMirror) {
  for (const bool quads : {true, false}) {
    const Mesh before = mirrored_mesh(quads);
    SmoothOptions options = options_for(quads);
    const Mesh after = test::smoothed_alone(before, options);
    EXPECT_NO_THROW(require_mirror_images(self(), after, MirrorAxis::x));
    EXPECT_TRUE(validate(after).empty());
    EXPECT_GT(summarise_quality(self(), after).smallest_degrees,
              summarise_quality(self(), before).smallest_degrees);
    options.mirror.reset();
    const Mesh without = test::smoothed_alone(before, options);
    EXPECT_THROW(require_mirror_images(self(), without, MirrorAxis::x), InputError);
  }
}

TEST(SmoothMirrored, MovesNodesOnTheAxisAlongIt) {
  const Mesh before = mirrored_mesh(true);
  const Mesh after = test::smoothed_alone(before, options_for(true));
  int moved = 0;
  for (std::size_t i = 0; i < before.points.size(); ++i) {
    if (before.points[i].y != 0) continue;
    EXPECT_EQ(after.points[i].y, 0);
    moved += after.points[i].x != before.points[i].x ? 1 : 0;
  }
  EXPECT_GT(moved, 4);
}

TEST(SmoothMirrored, IsTheSameOnAnyNumberOfRanks) {
  for (const bool quads : {true, false}) {
    const Mesh mesh = mirrored_mesh(quads);
    test::expect_same_positions(mesh, [&](const Mesh&) { return options_for(quads); });
    const test::Smoothed s = test::smooth_both_ways(mesh, test::shuffled_order(mesh, 9),
                                                    [&](const Mesh&) { return options_for(quads); });
    auto own = s.part.triangles;
    for (auto& t : own)
      for (NodeId& node : t) node = NodeId{static_cast<std::int32_t>(s.part.global(node).value())};
    EXPECT_TRUE(test::world().all_gather_values(std::span<const std::array<NodeId, 3>>(own)) ==
                s.alone.triangles);
  }
}

/// Slots: new triangles near the old ones, as many on one side as on the other.
TEST(SmoothMirrored, TellsHowManyTrianglesStandInEachSlot) {
  const Mesh before = mirrored_mesh(false);
  SmoothOptions options = options_for(false);
  options.keep_slots = false;
  SmoothReport report;
  const Mesh after = test::smoothed_alone(before, options, &report);
  ASSERT_EQ(report.standing.size(), before.triangles.size());
  const std::size_t half = before.triangles.size() / 2;
  std::int64_t sum = 0, changed = 0;
  for (std::size_t i = 0; i < half; ++i) {
    EXPECT_EQ(report.standing[i], report.standing[half + i]) << "with_image() puts images behind";
    sum += 2 * report.standing[i];
    changed += report.standing[i] != 1 ? 1 : 0;
  }
  EXPECT_EQ(sum, std::ssize(after.triangles));
  EXPECT_GT(changed, 0);
  EXPECT_NO_THROW(require_mirror_images(self(), after, MirrorAxis::x));
}

TEST(SmoothMirrored, NodesStayWhoseImagesArePinned) {
  const Mesh before = mirrored_mesh(true);
  SmoothOptions options = options_for(true);
  options.pinned.resize(before.owned_nodes, 0);
  for (const NodeId node : options.pinned.ids())
    options.pinned[node] = before.point(node).y < 0 && before.point(node).x < 1 ? 1 : 0;
  const Mesh after = test::smoothed_alone(before, options);
  int kept = 0, moved = 0;
  for (std::size_t i = 0; i < before.points.size(); ++i) {
    const Point p = before.points[i];
    if (p.x >= 1 || p.y == 0) {
      moved += after.points[i] != p ? 1 : 0;
      continue;
    }
    EXPECT_EQ(after.points[i], p);
    ++kept;
  }
  EXPECT_GT(kept, 80) << "images of pinned nodes as well";
  EXPECT_GT(moved, 40) << "the others are smoothed";
}

TEST(SmoothMirrored, RefusesAMeshThatIsNone) {
  Mesh mesh = mirrored_mesh(true);
  mesh.points[20].x += 1e-9;
  EXPECT_THROW(test::smoothed_alone(mesh, options_for(true)), InputError);
}

}  // namespace
}  // namespace quadloop::smoother
