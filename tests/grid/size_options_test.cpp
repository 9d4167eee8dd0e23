// Which leaves a source meets. On one rank alone.
#include "mesher/grid/size_options.hpp"

#include <gtest/gtest.h>

namespace quadloop {
namespace {

constexpr Box unit{{0, 0}, {1, 1}};

TEST(SizeSource, ABoxMeetsWhatItTouches) {
  EXPECT_TRUE(meets({Box{{1, 1}, {2, 2}}, 1}, unit));
  EXPECT_TRUE(meets({Box{{-5, 0.5}, {9, 0.6}}, 1}, unit));
  EXPECT_FALSE(meets({Box{{1.001, 0}, {2, 1}}, 1}, unit));
}

TEST(SizeSource, ADiscMeetsByItsRadius) {
  EXPECT_TRUE(meets({SizeSource::Disc{{0.5, 0.5}, 0.01}, 1}, unit));
  EXPECT_TRUE(meets({SizeSource::Disc{{4, 5}, 5}, 1}, unit)) << "it touches the corner";
  EXPECT_FALSE(meets({SizeSource::Disc{{4, 5}, 4.999}, 1}, unit)) << "its box meets the leaf";
  EXPECT_TRUE(meets({SizeSource::Disc{{1, 0.5}, 0}, 1}, unit)) << "a point";
}

TEST(SizeSource, ALineMeetsWhereItRuns) {
  const auto line = [](Point from, Point to) { return meets({SizeSource::Line{from, to}, 1}, unit); };
  EXPECT_TRUE(line({-1, 0.5}, {2, 0.5}));
  EXPECT_TRUE(line({0.4, 0.4}, {0.6, 0.6})) << "within";
  EXPECT_TRUE(line({0, 2}, {2, 0})) << "through a corner";
  EXPECT_FALSE(line({0, 2.01}, {2.01, 0})) << "past the corner, though the boxes meet";
  EXPECT_FALSE(line({2, 2}, {3, 3})) << "on its line, but not there";
  EXPECT_TRUE(line({0.5, 0.5}, {0.5, 0.5})) << "a point";
  EXPECT_FALSE(line({1.5, 0.5}, {1.5, 0.5}));
}

}  // namespace
}  // namespace quadloop
