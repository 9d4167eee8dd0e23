#include "flow/euler/scheme/skewness.hpp"

#include <gtest/gtest.h>

namespace quadloop::flow::euler {
namespace {

/// An edge of this height on a face of width 1 whose middle lies `apart` above the edge's.
SkewFace face_of(double height, double apart) {
  const Skewness of_middle{{}, {0, apart}}, left_over{{0.01, 0}, {0, 0.02}};
  return {{0, height}, 1, {0, 1}, of_middle, left_over, of_middle + left_over};
}

/// Of a node in a grid of such cells.
Nearness nearness_of(double height) {
  Nearness nearness;
  for (const Point edge : {Point{1, 0}, {-1, 0}, {0, height}, {0, -height}}) nearness.add(edge);
  return nearness;
}

TEST(Nearness, CountsWaysInEdges) {
  const Nearness nearness = nearness_of(0.1);
  EXPECT_NEAR(nearness.reach({1, 0}), std::sqrt(2), 1e-15);
  EXPECT_NEAR(nearness.reach({0, 0.1}), std::sqrt(2), 1e-14);
  EXPECT_NEAR(nearness.reach({0, 0.2}), 2 * std::sqrt(2), 1e-14);
}

TEST(Skewness, IsWholeInCellsOfModerateShape) {
  const SkewFace face = face_of(0.5, 0.2);
  const Skewness kept = bearable(face, nearness_of(0.5), nearness_of(0.5));
  EXPECT_EQ(kept.with_x, face.sum.with_x);
  EXPECT_EQ(kept.with_y, face.sum.with_y);
}

TEST(Skewness, GoesWhereTheMiddleLiesFarBeyondTheNeighbours) {
  const SkewFace face = face_of(0.01, 0.02);
  const Skewness kept = bearable(face, nearness_of(0.01), nearness_of(0.5));
  EXPECT_EQ(kept.with_x, face.left_over.with_x);
  EXPECT_EQ(kept.with_y, face.left_over.with_y);
  const Skewness some = bearable(face_of(0.01, 0.0075), nearness_of(0.01), nearness_of(0.01));
  EXPECT_GT(some.with_y.y, 0.02);
  EXPECT_LT(some.with_y.y, 0.0275);
}

TEST(Skewness, LeavesNothingOverBesideSmallFaces) {
  EXPECT_EQ(share_left_over(1, 0.5), 1);
  EXPECT_EQ(share_left_over(1, 0.05), 1);
  EXPECT_EQ(share_left_over(1, 0.02), 0);
  EXPECT_EQ(share_left_over(1, 0), 0);
}

}  // namespace
}  // namespace quadloop::flow::euler
