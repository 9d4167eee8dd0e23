#include "mesher/base/id_vector.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace quadloop {
namespace {

using Words = IdVector<NodeId, std::string>;

TEST(IdVector, KeepsAValueForEachId) {
  Words words;
  EXPECT_TRUE(words.empty());
  words.reserve(2);
  const NodeId first = words.push_back("one"), second = words.push_back("two");
  EXPECT_EQ(first, NodeId{0});
  EXPECT_EQ(second, NodeId{1});
  words[first] += "!";
  EXPECT_EQ(words[first], "one!");
  EXPECT_EQ(words[second], "two");
  EXPECT_EQ(words.size(), 2U);
}

TEST(IdVector, StartsAndGrowsWithTheValueGiven) {
  IdVector<LeafId, std::int32_t> counts(2, 7);
  counts.resize(3, -1);
  EXPECT_EQ(counts, (IdVector<LeafId, std::int32_t>{std::vector<std::int32_t>{7, 7, -1}}));
  counts.resize(1);
  EXPECT_EQ(counts, (IdVector<LeafId, std::int32_t>{std::vector<std::int32_t>{7}}));
  EXPECT_EQ((IdVector<NodeId, double>(1)[NodeId{0}]), 0);
}

TEST(IdVector, GivesItsIdsInTheirOrder) {
  const Words words(3);
  std::vector<NodeId> ids;
  for (const NodeId node : words.ids()) ids.push_back(node);
  EXPECT_EQ(ids, (std::vector{NodeId{0}, NodeId{1}, NodeId{2}}));
  EXPECT_TRUE(Words{}.ids().empty());
}

TEST(IdVector, GivesItsValuesInTheOrderOfTheIds) {
  IdVector<BoundaryId, double> values(std::vector{0.5, 1.5, 2.5});
  EXPECT_EQ(std::accumulate(values.begin(), values.end(), 0.0), 4.5);
  for (double& value : values) value *= 2;
  const std::span<const double> span = values;
  EXPECT_EQ(span.data(), values.data());
  EXPECT_EQ(span.size(), 3U);
  EXPECT_EQ(span[2], values[BoundaryId{2}]);
  EXPECT_EQ(span[2], 5);
}

TEST(IdVector, IdsBelowAnyOfAnyWidth) {
  std::int64_t sum = 0;
  for (const GlobalNodeId node : ids_below(GlobalNodeId{4})) sum += node.value();
  EXPECT_EQ(sum, 6);
  EXPECT_TRUE(ids_below(GlobalNodeId{0}).empty());
  EXPECT_EQ(*ids_between(LeafId{3}, LeafId{5}).begin(), LeafId{3});
  EXPECT_EQ(ids_between(LeafId{3}, LeafId{5}).size(), 2U);
}

}  // namespace
}  // namespace quadloop
