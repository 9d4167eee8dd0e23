// Entries of OpenFOAM's dictionaries.
#include "io/foam/foam_text.hpp"

#include <gtest/gtest.h>

namespace quadloop::io {
namespace {

std::string word_of_key(const std::string& text, const std::string& key) {
  const std::string plain = without_foam_comments(text);
  const auto entry = foam_entry(foam_entries(plain), key);
  return entry ? foam_word(plain, *entry) : "none";
}

TEST(FoamText, EntriesAreThoseOutsideSubdictionaries) {
  const std::string text =
      "FoamFile { class dictionary; }\n#include \"a b;\"\n// key 1;\n/* key\n 2; */\ninner { key 3; deep { "
      "key 4; } "
      "}\nkey 5;list (1 { a; } 2); key   \"six\" ; \"quoted.*\"\n{ x y; }\nempty;\nlast 7";
  EXPECT_EQ(word_of_key(text, "key"), "six") << "the last one";
  EXPECT_EQ(word_of_key(text, "class"), "none");
  EXPECT_EQ(word_of_key(text, "list"), "(1");
  EXPECT_EQ(word_of_key(text, "quoted.*"), "x");
  EXPECT_EQ(word_of_key(text, "empty"), "");
  EXPECT_EQ(word_of_key(text, "last"), "none") << "it has no end";
  EXPECT_EQ(word_of_key("", "key"), "none");
  const std::string inner = without_foam_comments(text);
  const auto block = foam_entry(foam_entries(inner), "inner");
  ASSERT_TRUE(block && block->is_block);
  const auto deep = foam_entry(foam_entries(inner, block->begin, block->end), "deep");
  ASSERT_TRUE(deep && deep->is_block);
  EXPECT_EQ(inner.substr(deep->begin, deep->end - deep->begin), " key 4; ");
}

TEST(FoamText, DamagedTextsHaveNoEntriesOrSome) {
  const std::string whole = "a { b \"c\"; } d (e {f;}) ; g;";
  for (std::size_t length = 0; length <= whole.size(); ++length) foam_entries(whole.substr(0, length));
  EXPECT_EQ(foam_entries("}} ) ; a b;").size(), 1U);
  EXPECT_TRUE(foam_entries("\"").empty());
  EXPECT_TRUE(foam_entries("# no end").empty());
}

TEST(FoamText, KnowsSwitches) {
  for (const char* word : {"on", "yes", "true", "compressed"}) EXPECT_TRUE(is_foam_true(word)) << word;
  for (const char* word : {"off", "no", "false", "uncompressed", ""})
    EXPECT_FALSE(is_foam_true(word)) << word;
}

}  // namespace
}  // namespace quadloop::io
