// Named nodes in the comments of a native mesh file.
#include "io/model/node_text.hpp"

#include <gtest/gtest.h>

namespace quadloop::io {
namespace {

TEST(NodeText, IsReadAsWritten) {
  const std::vector<NamedNode> nodes{{"probe", GlobalNodeId{0}}, {"point load", GlobalNodeId{6}}};
  EXPECT_EQ(comment_of(nodes[1]), "# node 7 point load\n");
  EXPECT_EQ(nodes_in_comments("# other\n" + comment_of(nodes[0]) + "# nodes 1-3\n" + comment_of(nodes[1]), 7),
            nodes);
}

TEST(NodeText, DamagedOnesAreLeftOut) {
  for (const char* text :
       {"# node 8 a\n", "# node 0 a\n", "# node 3\n", "# node a 3\n", "# node\n", "# node 3x a\n", ""})
    EXPECT_TRUE(nodes_in_comments(text, 7).empty()) << text;
}

}  // namespace
}  // namespace quadloop::io
