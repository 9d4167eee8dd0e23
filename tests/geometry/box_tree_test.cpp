#include "mesher/geometry/box_tree.hpp"

#include <gtest/gtest.h>

#include <random>

#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {
namespace {

struct Segment {
  Point a, b;
};

/// Short segments with ends on a coarse grid, so that many touch, repeat, or are points.
std::vector<Segment> segments(std::size_t count) {
  std::mt19937_64 random(5);
  const auto number = [&](std::uint64_t range) { return static_cast<double>(random() % range); };
  std::vector<Segment> all(count);
  for (auto& [a, b] : all) {
    a = {number(40), number(40)};
    b = a + Point{number(4), number(4)};
  }
  return all;
}

BoxTree tree_of(const std::vector<Segment>& all) {
  std::vector<Box> boxes;
  for (const auto& [a, b] : all) boxes.push_back(box_of(a, b));
  return BoxTree(boxes);
}

std::vector<std::int32_t> meeting(const BoxTree& tree, const Box& box) {
  std::vector<std::int32_t> found;
  tree.for_each_meeting(box, [&](std::int32_t number) { found.push_back(number); });
  return found;
}

TEST(BoxTree, FindsWhatMeetsABoxAndNothingElse) {
  for (const std::size_t count : {0U, 1U, 8U, 9U, 17U, 500U}) {
    const std::vector<Segment> all = segments(count);
    const BoxTree tree = tree_of(all);
    EXPECT_EQ(tree.empty(), count == 0);
    for (double x = -2; x < 45; x += 1.5) {
      const Box box{{x, 2 * x - 40}, {x + 3, 2 * x - 36}};
      std::vector<std::int32_t> wanted, found = meeting(tree, box);
      for (std::size_t i = 0; i < count; ++i) {
        if (box_of(all[i].a, all[i].b).meets(box)) wanted.push_back(static_cast<std::int32_t>(i));
      }
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, wanted);
    }
  }
}

TEST(BoxTree, ABoxThatTouchesMeets) {
  const BoxTree tree = tree_of({{{0, 0}, {1, 1}}});
  EXPECT_EQ(meeting(tree, {{1, 1}, {2, 2}}).size(), 1U);
  EXPECT_TRUE(meeting(tree, {{std::nextafter(1.0, 2), 1}, {2, 2}}).empty());
}

TEST(BoxTree, EndsWhereItIsTold) {
  const BoxTree tree = tree_of(segments(100));
  int asked = 0;
  EXPECT_TRUE(tree.any_meeting({{-1, -1}, {50, 50}}, [&](std::int32_t) { return ++asked == 3; }));
  EXPECT_EQ(asked, 3);
  EXPECT_FALSE(tree.any_meeting({{-1, -1}, {50, 50}}, [](std::int32_t) { return false; }));
}

TEST(BoxTree, OfEquallyNearTheLowestNumberIsNearest) {
  const std::vector<Segment> all = segments(400);
  const BoxTree tree = tree_of(all);
  for (double x = -3; x < 45; x += 0.5) {
    const Point p{x, 30 - x};
    const auto distance = [&](std::int32_t number) {
      const auto& [a, b] = all[number];
      return place_on_segment(p, a, b).squared_distance;
    };
    std::int32_t wanted = 0;
    for (std::int32_t i = 1; i < 400; ++i) {
      if (distance(i) < distance(wanted)) wanted = i;
    }
    EXPECT_EQ(tree.nearest(p, distance), wanted);
  }
  EXPECT_EQ(BoxTree().nearest({0, 0}, [](std::int32_t) { return 0.0; }), BoxTree::none);
}

TEST(BoxTree, NearestBox) {
  const BoxTree tree = tree_of({{{0, 0}, {1, 1}}, {{3, 0}, {4, 4}}, {{3, 0}, {4, 4}}});
  EXPECT_EQ(tree.nearest_box({1.5, 0}), 0);
  EXPECT_EQ(tree.nearest_box({2.5, 0}), 1);
  EXPECT_EQ(tree.nearest_box({3.5, 1}), 1);  // inside
  EXPECT_EQ(BoxTree().nearest_box({0, 0}), BoxTree::none);
}

}  // namespace
}  // namespace quadloop
