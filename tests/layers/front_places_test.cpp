// Nodes of the outer mesh, found on the front.
#include "mesher/layers/front_places.hpp"

#include <gtest/gtest.h>

#include "tests/layers/walls.hpp"

namespace quadloop {
namespace {

using test::four_layers;

constexpr BoundaryId floor_id{0}, rest_id{1};

TEST(FrontPlaces, AStationAndBetweenTwo) {
  const Geometry geometry = test::floor_with_layers(four_layers);
  const LayerFront front = layer_front(geometry);
  const FrontPlaces places(front);
  const FrontPlace at = places.locate({0.125, 0.5}, floor_id),
                   between = places.locate({0.140625, 0.5}, floor_id);
  EXPECT_TRUE(at.valid() && at.at_station());
  EXPECT_EQ(at.station, 2);
  EXPECT_TRUE(between.valid());
  EXPECT_FALSE(between.at_station());
  EXPECT_EQ(between.station, 2);
  EXPECT_EQ(between.share, 0.25);
  EXPECT_EQ(between.rest, 0.75);
}

TEST(FrontPlaces, TheEndOfARunIsAStationToo) {
  const Geometry geometry = test::floor_with_layers(four_layers);
  const LayerFront front = layer_front(geometry);
  const FrontPlace end = FrontPlaces(front).locate({8, 0.5}, floor_id);
  EXPECT_EQ(end.station, front.line.size() - 1);
  EXPECT_TRUE(end.at_station());
}

TEST(FrontPlaces, ABoundaryWithoutAFrontHasNone) {
  const Geometry geometry = test::floor_with_layers(four_layers);
  const LayerFront front = layer_front(geometry);
  EXPECT_FALSE(FrontPlaces(front).locate({8, 0.5}, rest_id).valid());
}

TEST(FrontPlaces, FollowEachOtherOnOneLineOfWall) {
  const Geometry geometry = test::floor_with_layers(four_layers);
  const LayerFront front = layer_front(geometry);
  const FrontPlaces places(front);
  const FrontPlace a = places.locate({1.0, 0.5}, floor_id), b = places.locate({1.01, 0.5}, floor_id),
                   c = places.locate({1.5, 0.5}, floor_id);
  EXPECT_TRUE(places.follows(a, b) && places.follows(b, c) && places.follows(a, c));
  EXPECT_FALSE(places.follows(b, a) || places.follows(c, b) || places.follows(a, a));
  EXPECT_FALSE(places.follows(a, FrontPlace{}) || places.follows(FrontPlace{}, a));
}

TEST(FrontPlaces, RoundALoopAnEdgeMayLeadPastMostStations) {
  const Geometry geometry = test::rhombus_with_layers(four_layers, 0.25);
  const LayerFront front = layer_front(geometry);
  const FrontPlaces places(front);
  const FrontPlace last{front.line.size() - 2}, first{3};
  EXPECT_TRUE(places.follows(last, first));
  EXPECT_TRUE(places.follows(first, last));
  EXPECT_FALSE(places.follows(last, last));
}

}  // namespace
}  // namespace quadloop
