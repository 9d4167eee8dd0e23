#include "io/model/pair_text.hpp"

#include <gtest/gtest.h>

namespace quadloop::io {
namespace {

TEST(PairText, APairComesBackAsItWas) {
  const std::vector<PeriodicPair> pairs{{"lower", "upper", {0.1, 1.0 / 3}}, {"a", "b", {}, 22.5, {-1e-3, 2}}};
  Mesh mesh;
  mesh.pairs = pairs;
  EXPECT_EQ(comments_of(mesh),
            "# pair lower upper translation 0.1 0.3333333333333333\n# pair a b rotation 22.5 -0.001 2\n");
  EXPECT_EQ(pairs_in_comments("# other\n" + comments_of(mesh) + "# pair\n"), pairs);
}

TEST(PairText, WhatIsNoPairIsPassedOver) {
  for (const char* text :
       {"# pair a b translation 1", "# pair a b shift 1 2", "# pair a a translation 1 2",
        "# pair a b translation 1 x", "# pair a b translation 1 2 3", "# pair a b rotation 1"})
    EXPECT_TRUE(pairs_in_comments(text).empty()) << text;
}

}  // namespace
}  // namespace quadloop::io
