// How coarse a mesh is at a place.
#include "mesher/mesh/check/cell_reach.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <vector>

#include "tests/mesh/square_and_triangle.hpp"

namespace quadloop {
namespace {

struct Reach {
  Mesh mesh = test::square_and_triangle();
  std::vector<double> longest{8.1, 1};
  CellReach reach{mesh, longest};
};

TEST(CellReach, LongCellsCountLessTheFartherTheyAre) {
  Reach r;
  EXPECT_EQ(r.reach.size_at({5, 0.25}, 100), 8.1) << "inside";
  EXPECT_EQ(r.reach.size_at({0, 0.5}, 100), 8.1 - 0.5 * 1);
  EXPECT_EQ(r.reach.size_at({0.5, 0.5}, 0.25), 1) << "enough is found before the triangle is looked for";
}

TEST(CellReach, BeyondItsReachTheNearestCellCounts) {
  Reach r;
  EXPECT_EQ(r.reach.size_at({-1000, 0}, 1), 0);
  EXPECT_EQ(r.reach.longest_within({-1000, 0}, 1), 0);
  const CellReach::Nearest nearest = r.reach.nearest({-1000, 0});
  EXPECT_EQ(nearest.longest, 1);
  EXPECT_EQ(nearest.squared_distance, 1e6);
  const Communicator alone(MPI_COMM_SELF);
  EXPECT_EQ(answers_over(alone, r.mesh, r.longest, {{{-1000, 0}, 1, true}, {{-1000, 0}, 1, false}}),
            (std::vector<double>{1, 1}));
}

TEST(CellReach, LongestWithinADistance) {
  Reach r;
  EXPECT_EQ(r.reach.longest_within({0, 0.5}, 0.9), 1);
  EXPECT_EQ(r.reach.longest_within({0, 0.5}, 1), 8.1) << "closed";
}

TEST(CellReach, OfNoCellsIsNothing) {
  const Mesh mesh;
  const std::vector<double> longest;
  CellReach reach(mesh, longest);
  EXPECT_EQ(reach.size_at({0, 0}, 1), 0);
  EXPECT_EQ(reach.longest_within({0, 0}, 1), 0);
}

}  // namespace
}  // namespace quadloop
