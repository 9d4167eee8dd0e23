// Strips as comments: what is written reads back, and what is no strip of the mesh is told.
#include "io/model/strip_text.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace quadloop::io {
namespace {

/// Of two columns with runs upwards, downwards and single nodes.
StripLayers strip_of(const std::string& name, bool from_wall) {
  StripLayers strip{name, {2, 0.1 + 0.2}, from_wall, 5, {}};
  for (const int node : {7, 6, 5, 20, 21, 10, 30, 31, 32, 40}) strip.nodes.emplace_back(node);
  return strip;
}

TEST(StripText, ReadsBackWhatItWrites) {
  const StripLayers wake = strip_of("wake_1", true), line = strip_of("layer_line", false);
  const std::string text = comments_of(wake);
  EXPECT_EQ(text, "# strip wake_1 2 0.30000000000000004 5 2 wake\n# nodes 8-6 21-22 11 31-33 41\n");
  const StripsInText found = strips_in_comments("# another comment\n" + text + comments_of(line), 41);
  EXPECT_EQ(found.strips, (std::vector{wake, line}));
  EXPECT_TRUE(found.damaged.empty());
}

TEST(StripText, LongStripsTakeShortLines) {
  StripLayers strip{"wake", {30, 0.01}, true, 61, std::vector<GlobalNodeId>(61 * 400)};
  for (std::size_t i = 0; i < strip.nodes.size(); ++i)
    strip.nodes[i] = GlobalNodeId{static_cast<std::int64_t>(i ^ 1U)};  // runs of two, downwards
  const std::string text = comments_of(strip);
  EXPECT_EQ(strips_in_comments(text, 61 * 400).strips, std::vector{strip});
  for (std::size_t begin = 0, end = text.find('\n'); end != std::string::npos;
       begin = end + 1, end = text.find('\n', begin)) {
    EXPECT_LT(end - begin, 120U);
    EXPECT_EQ(text[begin], '#');
  }
}

TEST(StripText, DamagedOnesAreNamedAndLeftOut) {
  const std::string text = comments_of(strip_of("wake", true));
  const auto damaged = [](const std::string& comments, std::int32_t nodes = 41) {
    const StripsInText found = strips_in_comments(comments, nodes);
    EXPECT_TRUE(found.strips.empty()) << comments;
    return found.damaged;
  };
  const std::vector<std::string> wake{"wake"};
  const auto with = [&](const std::string& what, const std::string& by) {
    std::string changed = text;
    return changed.replace(changed.find(what), what.size(), by);
  };
  EXPECT_EQ(damaged(text, 40), wake) << "a node that there is none of";
  EXPECT_EQ(damaged(with(" 41", "")), wake) << "too few nodes";
  EXPECT_EQ(damaged(with(" 41", " 41 42"), 50), wake) << "too many";
  EXPECT_EQ(damaged(with(" 41", " 8")), wake) << "one twice";
  EXPECT_EQ(damaged(with(" 41", " x")), wake);
  EXPECT_EQ(damaged(with(" 41", " 1-2000000000")), wake);
  EXPECT_EQ(damaged(with("# strip wake 2", "# strip wake 3")), wake) << "more layers than nodes across";
  EXPECT_EQ(damaged(with(" wake\n", " sleep\n")), wake);
  EXPECT_EQ(damaged(with("0.3", "-0.3")), wake);
  EXPECT_TRUE(damaged("# a strip of land\n# nodes 1-3\n").empty());
}

}  // namespace
}  // namespace quadloop::io
