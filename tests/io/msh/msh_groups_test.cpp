// Physical groups and tags of nodes. On one rank alone.
#include "io/msh/msh_groups.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "io/msh/msh_nodes.hpp"

namespace quadloop::io {
namespace {

TEST(MshGroups, SignsSayNothing) {
  MshGroups groups;
  groups.name_physical(1, -7, "wall");
  groups.put_in_physical(1, 30, -7);
  EXPECT_EQ(groups.physical_of(1, 30), 7);
  EXPECT_EQ(groups.physical_of(2, 30), 0) << "a surface of that tag";
  EXPECT_EQ(groups.physical_of(1, 31), 0);
  EXPECT_EQ(groups.name_of(1, 7), "wall");
  EXPECT_EQ(groups.members_of(1, 7), 1);
}

TEST(MshGroups, AGroupWithoutANameHasItsNumber) {
  MshGroups groups;
  groups.name_physical(1, 8, "");
  EXPECT_EQ(groups.name_of(1, 8), "physical_8");
  EXPECT_EQ(groups.name_of(1, 9), "physical_9");
}

NodeTags tagged(const std::vector<std::int64_t>& tags, std::int64_t expected_twice = 0) {
  NodeTags nodes;
  for (const std::int64_t tag : tags) nodes.add(tag);
  EXPECT_EQ(nodes.sort(), expected_twice);
  return nodes;
}

TEST(NodeTags, MayHaveGapsAndComeInAnyOrder) {
  for (const auto& tags :
       {std::vector<std::int64_t>{1, 2, 3}, {9, 4, 7}, {-5, 1000000000000, 2}, {3, 4, 6}}) {
    const NodeTags nodes = tagged(tags);
    for (std::size_t i = 0; i < tags.size(); ++i)
      EXPECT_EQ(nodes.node_of(tags[i]).value(), static_cast<std::int32_t>(i));
    for (const std::int64_t absent :
         {std::int64_t{0}, std::int64_t{5}, std::numeric_limits<std::int64_t>::max()})
      EXPECT_FALSE(nodes.node_of(absent).valid());
  }
}

TEST(NodeTags, GivenTwiceOrNotAtAll) {
  tagged({4, 2, 9, 2}, 2);
  EXPECT_FALSE(tagged({}).node_of(1).valid());
}

}  // namespace
}  // namespace quadloop::io
