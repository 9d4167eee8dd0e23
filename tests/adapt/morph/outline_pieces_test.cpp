#include "adapt/morph/outline_pieces.hpp"

#include <gtest/gtest.h>

#include "adapt/morph/outline_map.hpp"
#include "smoother/outline/outline_path.hpp"

namespace quadloop::adapt {
namespace {

Chain line_of(const std::string& name, const std::vector<Point>& points) {
  return {name, true, points, "test"};
}

const std::vector<Point> straight{{1, 0}, {1, 0.3}, {1, 1}}, leaning{{1.1, 0}, {1.25, 0.3}, {1.6, 1}};
std::vector<Point> back(std::vector<Point> points) { return {points.rbegin(), points.rend()}; }

TEST(OutlinePieces, NodesOfBothSidesOfABaffleMoveAlike) {
  const auto pieces = pieces_of({line_of("left", straight), line_of("right", back(straight))},
                                {line_of("left", leaning), line_of("right", back(leaning))});
  ASSERT_TRUE(pieces);
  ASSERT_EQ(pieces->from.loop_count(), 2);
  const OutlineMap map(pieces->from, pieces->to);
  const smoother::OutlinePath path(pieces->from);
  for (const double y : {0.0, 0.1, 0.3, 0.77, 1.0}) {
    const auto left = path.locate({1, y}, "left"), right = path.locate({1, y}, "right");
    ASSERT_TRUE(left.valid() && right.valid());
    EXPECT_NE(left.loop, right.loop);
    EXPECT_EQ(map.image(left.loop, left.arc), map.image(right.loop, right.arc)) << y;
  }
  const auto third = path.locate({1, 0.65}, "right");  // half the second segment
  EXPECT_NEAR(map.image(third.loop, third.arc).x, 1.425, 1e-14);
  EXPECT_NEAR(map.image(third.loop, third.arc).y, 0.65, 1e-14);
}

TEST(OutlinePieces, CorrespondOnlyWithTheSameNamesAndNumbersOfPoints) {
  EXPECT_TRUE(pieces_of({line_of("a", straight)}, {line_of("a", leaning)}));
  EXPECT_FALSE(pieces_of({line_of("a", straight)}, {line_of("b", leaning)}));
  EXPECT_FALSE(pieces_of({line_of("a", straight)}, {line_of("a", {{0, 0}, {1, 1}})}));
  EXPECT_FALSE(pieces_of({line_of("a", straight)}, {}));
  Chain closed = line_of("a", leaning);
  closed.open = false;
  EXPECT_FALSE(pieces_of({line_of("a", straight)}, {closed}));
}

}  // namespace
}  // namespace quadloop::adapt
