// Tokens of a text that all ranks read are those that one rank reads, with their lines, however small the
// pieces.
#include "io/text/range_tokens.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "io/text/text_scanner.hpp"
#include "mesher/base/error.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::TemporaryFolder;
using test::world;

/// A text of tokens, comments, empty and long lines; the same on all ranks.
std::string random_text(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](std::size_t end) { return random() % end; };
  std::string text;
  for (std::size_t lines = below(60); lines > 0; --lines) {
    for (std::size_t tokens = below(5); tokens > 0; --tokens) {
      text += std::string(below(3), ' ') + std::string(1 + below(9), static_cast<char>('a' + below(26)));
      text += below(5) == 0 ? "#x\t" : "\t";
    }
    if (below(3) == 0) text += " # a comment" + std::string(below(40), '.');
    if (below(8) != 0 || lines > 1) text += "\n";
  }
  return text;
}

struct Placed {
  std::string token;
  std::int64_t line;
  friend bool operator==(const Placed&, const Placed&) = default;
};

std::vector<Placed> tokens_of_one(const std::string& path) {
  TextScanner scan(path);
  std::vector<Placed> tokens;
  while (!scan.at_end()) {
    const std::string token(scan.token("a token"));
    const auto place = scan.place();
    tokens.push_back({token, 1 + std::count(scan.text().begin(), scan.text().begin() + place, '\n')});
  }
  return tokens;
}

void expect_own_tokens(RangeTokens& tokens, const std::vector<Placed>& all) {
  if (tokens.begin() == tokens.end()) return;
  tokens.go_to(tokens.begin());
  for (std::int64_t i = tokens.begin(); i < tokens.end(); ++i) EXPECT_EQ(tokens.next(), all[i].token);
  for (std::int64_t i = tokens.begin(); i < tokens.end(); i += 3) {
    tokens.go_to(i);
    EXPECT_EQ(tokens.next(), all[i].token);
    EXPECT_EQ(tokens.line_of(tokens.place()), all[i].line);
  }
}

TEST(RangeTokens, AreThoseThatOneRankReads) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const TemporaryFolder folder;
    const std::string path = folder.write("a.txt", random_text(seed));
    const std::vector<Placed> all = tokens_of_one(path);
    for (const std::size_t piece : {1, 7, 100, 1000000}) {
      RangeTokens tokens(world(), path, piece);
      EXPECT_EQ(world().sum(tokens.end() - tokens.begin()), std::ssize(all)) << seed << ' ' << piece;
      EXPECT_EQ(tokens.begin(), world().exclusive_sum(tokens.end() - tokens.begin()));
      expect_own_tokens(tokens, all);
    }
  }
}

TEST(RangeTokens, TextBeforeATokenIsThatSinceTheOneBefore) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.txt", "# first\n  1 2 # two\n# and\n\n# more\n3\n# behind");
  for (const std::size_t piece : {1, 1000}) {
    RangeTokens tokens(world(), path, piece);
    std::string before;  // the third token, on all ranks that have a part of it
    if (tokens.begin() <= 2 && 2 <= tokens.end()) before = tokens.text_before(2);
    const std::vector<char> all = world().all_gather_values(std::span<const char>(before));
    if (world().size() == 1) {
      EXPECT_EQ(tokens.text_before(0), "# first\n  ");
      EXPECT_EQ(tokens.text_before(3), "\n# behind");
      EXPECT_EQ(tokens.next_place(), tokens.file_size());
      EXPECT_EQ(tokens.text_before(3), "\n# behind") << "again";
    }
    EXPECT_EQ(std::string(all.begin(), all.end()), " # two\n# and\n\n# more\n");
  }
}

TEST(RangeTokens, FailOnAllRanksTogether) {
  const TemporaryFolder folder;
  EXPECT_THROW(RangeTokens(world(), folder.file("missing"), 10), InputError);
  EXPECT_THROW(RangeTokens(world(), folder.path(), 10), InputError);
}

}  // namespace
}  // namespace quadloop::io
