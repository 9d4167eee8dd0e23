// Boundary nodes spread evenly along flagged segments of the outline.
#include "smoother/even_widths.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/smoother/whole_meshes.hpp"

namespace quadloop::smoother {
namespace {

using test::world;

/// A grid whose lower side's nodes stand unevenly, inside the square that is its outline.
struct Uneven {
  Uneven() {
    for (std::int32_t i = 1; i < 8; ++i) mesh.points[i].x += 0.04 * test::scattered(5, i, 0);
  }
  Geometry square{{{"wall", 0, 30, "wall"}, {"far", 0, 30, "none"}},
                  {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                  {0, 4},
                  {BoundaryId{0}, BoundaryId{0}, BoundaryId{1}, BoundaryId{1}}};
  Mesh mesh = test::Grid{8, {1, 1}, true}.mesh();
};

/// The positions after so many sweeps over `segments`, by the nodes' numbers; and whether any has moved.
std::pair<bool, std::map<std::int64_t, Point>> spread(const Communicator& comm, const Uneven& uneven,
                                                      const std::vector<double>& segments, int sweeps) {
  Mesh part = scatter_mesh(comm, uneven.mesh, own_order(uneven.mesh));
  HaloMesh halo(comm, part);
  const OutlinePath path(uneven.square);
  const NodeFlags pinned;
  BoundarySlide slide(comm, halo, part.boundaries, &path, pinned);
  const bool moved = even_widths(comm, halo, slide, segments, sweeps);
  std::map<std::int64_t, Point> positions;
  for (const NodeId node : ids_below(NodeId{part.owned_nodes}))
    positions.emplace(part.global(node).value(), halo.point(node));
  return {moved, positions};
}

/// Of neighbouring widths on the lower side, the largest ratio.
double unevenness(const std::map<std::int64_t, Point>& positions) {
  const auto width = [&](std::int64_t i) { return positions.at(i + 1).x - positions.at(i).x; };
  double most = 1;
  for (std::int64_t i = 1; i < 8; ++i)
    most = std::max({most, width(i) / width(i - 1), width(i - 1) / width(i)});
  return most;
}

TEST(EvenWidths, WidthsAlongFlaggedSegmentsComeTogether) {
  const Uneven uneven;
  const auto [moved, positions] = spread(test::self(), uneven, {1, 0, 0, 0}, 100);
  EXPECT_TRUE(moved);
  EXPECT_LT(unevenness(positions), 1.02);
  for (const auto& [node, p] : positions) {
    if (node < 9) {
      EXPECT_EQ(p.y, 0) << node;
    } else {
      EXPECT_EQ(p, uneven.mesh.points[node]) << "nodes elsewhere stay";
    }
  }
}

TEST(EvenWidths, NothingMovesElsewhere) {
  const Uneven uneven;
  const auto [moved, positions] = spread(test::self(), uneven, {0, 1, 1, 1}, 10);
  EXPECT_FALSE(moved) << "the other sides are even";
  EXPECT_EQ(positions.at(3), uneven.mesh.points[3]);
}

TEST(EvenWidths, AreTheSameOnAnyNumberOfRanks) {
  const Uneven uneven;
  const auto alone = spread(test::self(), uneven, {1, 0, 0, 0}, 7);
  const auto [moved, positions] = spread(world(), uneven, {1, 0, 0, 0}, 7);
  EXPECT_EQ(moved, alone.first) << "every rank knows";
  for (const auto& [node, p] : positions) EXPECT_EQ(p, alone.second.at(node)) << node;
}

TEST(EvenWidths, AreSmoothingsLastStepWhereItIsAskedFor) {
  const Uneven uneven;
  SmoothOptions options;
  options.geometry = &uneven.square;
  const auto unevenness_after = [&](std::vector<double> segments, int sweeps) {
    options.front_heights = std::move(segments);
    options.sweeps = sweeps;
    const Mesh mesh = test::smoothed_alone(uneven.mesh, options);
    std::map<std::int64_t, Point> positions;
    for (std::int64_t i = 0; i < 9; ++i) positions.emplace(i, mesh.points[i]);
    return unevenness(positions);
  };
  EXPECT_LT(unevenness_after({1, 0, 0, 0}, 1), 1.05);
  EXPECT_GT(unevenness_after({}, 1), 1.1);
  EXPECT_GT(unevenness_after({1, 0, 0, 0}, 0), 1.2) << "without sweeps the mesh stays as it is cut";
}

}  // namespace
}  // namespace quadloop::smoother
