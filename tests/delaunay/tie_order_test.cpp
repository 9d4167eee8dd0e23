// The rank of nodes on one circle. On one rank alone.
#include "mesher/delaunay/tie_order.hpp"

#include <gtest/gtest.h>

namespace quadloop {
namespace {

TEST(TieOrder, FartherNodesRankHigher) {
  EXPECT_LT(tie_rank({0, 0}, {1, 1}), tie_rank({0, 0}, {2, 0}));
  EXPECT_LT(tie_rank({0, 0}, {2, 0}), tie_rank({0, 0}, {2, 1})) << "the farther way first";
  EXPECT_LT(tie_rank({5, 5}, {4, 5}), tie_rank({5, 5}, {0, 5}));
}

TEST(TieOrder, MirrorImagesAndQuarterTurnsDifferInTheirCoordinatesAlone) {
  const Point centre{3, -2}, p{1.25, 2.5};
  const TieRank own = tie_rank(centre, centre + p);
  for (const Point image : {Point{-p.x, p.y}, Point{p.x, -p.y}, Point{-p.y, p.x}, Point{p.y, p.x}}) {
    TieRank other = tie_rank(centre, centre + image);
    EXPECT_NE(own, other);
    other.x = own.x;
    other.y = own.y;
    EXPECT_EQ(own, other);
  }
}

TEST(TieOrder, NodesOfTheLatticeRankAboveOthers) {
  EXPECT_LT(tie_rank({0, 0}, {9, 9}), (TieRank{0, 0, 0, 0, 0, 0}));
}

}  // namespace
}  // namespace quadloop
