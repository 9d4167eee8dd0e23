// Physical groups and tags of nodes. On one rank alone.
#include "io/msh/msh_groups.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "io/msh/msh_nodes.hpp"

namespace quadloop {
namespace {

TEST(MshGroups, SignsSayNothing) {
  MshGroups groups;
  groups.name_physical(1, -7, "wall");
  groups.put_in_physical(1, 30, -7);
  EXPECT_EQ(groups.physical_of(1, 30), 7);
  EXPECT_EQ(groups.physical_of(2, 30), 0) << "a surface of that tag";
  EXPECT_EQ(groups.physical_of(1, 31), 0);
  ForeignMesh foreign;
  EXPECT_EQ(groups.boundary_of(foreign, 7, 30), groups.boundary_of(foreign, -7, 99));
  EXPECT_EQ(foreign.loaded.mesh.boundaries[0].name, "wall");
}

TEST(MshGroups, BoundariesAreMadeAtTheirFirstElement) {
  MshGroups groups;
  groups.name_physical(1, 7, "never used");
  groups.name_physical(1, 8, "");
  ForeignMesh foreign;
  EXPECT_EQ(groups.boundary_of(foreign, 9, 1), 0);
  EXPECT_EQ(groups.boundary_of(foreign, 8, 1), 1);
  EXPECT_EQ(groups.boundary_of(foreign, 0, 12), 2);
  EXPECT_EQ(groups.boundary_of(foreign, 0, 13), 3);
  EXPECT_EQ(groups.boundary_of(foreign, 0, 12), 2);
  std::vector<std::string> names;
  for (const BoundaryEdges& boundary : foreign.loaded.mesh.boundaries) names.push_back(boundary.name);
  EXPECT_EQ(names, (std::vector<std::string>{"physical_9", "physical_8", "boundary_12", "boundary_13"}));
  EXPECT_EQ(groups.curves_without_group(), 2);
}

TEST(MshGroups, GroupsOfOneNameAreOneBoundary) {
  MshGroups groups;
  groups.name_physical(1, 1, "wall");
  groups.name_physical(1, 2, "wall");
  ForeignMesh foreign;
  EXPECT_EQ(groups.boundary_of(foreign, 1, 5), groups.boundary_of(foreign, 2, 6));
}

TEST(MshGroups, BlocksAreNamedApartFromBoundaries) {
  MshGroups groups;
  groups.name_physical(1, 1, "wall");
  groups.name_physical(2, 1, "fluid");
  ForeignMesh foreign;
  EXPECT_EQ(groups.block_of(foreign, 1), 0);
  EXPECT_EQ(groups.block_of(foreign, 0), 1);
  EXPECT_EQ(groups.block_of(foreign, -1), 0);
  EXPECT_EQ(foreign.loaded.block_names, (std::vector<std::string>{"fluid", "domain"}));
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
}  // namespace quadloop
