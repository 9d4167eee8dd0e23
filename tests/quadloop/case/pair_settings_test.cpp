// Tables [[pair]]: what they describe, and their refusals.
#include "quadloop/case/pair_settings.hpp"

#include <gtest/gtest.h>

#include "tests/io/input/temporary_file.hpp"

namespace quadloop {
namespace {

class PairSettings : public ::testing::Test {
 protected:
  PairSettings() {
    folder_.write(
        "box.geom",
        "4\nbottom open\n2\n0 0\n2 0\nright open\n2\n2 0\n2 1\ntop open\n2\n2 1\n0 1\nleft open\n2\n0 "
        "1\n0 0\n");
  }
  Settings read(const std::string& text) {
    return read_settings(folder_.write("case.toml", "[geometry]\nfile = \"box.geom\"\n" + text), {});
  }
  void expect_refused(const std::string& text, const std::string& piece) {
    const std::string said = test::refusal(folder_, [&] {
      Warnings warnings;
      load_geometry(read(text), warnings);
    });
    EXPECT_NE(said.find(piece), std::string::npos) << text << "\n" << said;
  }

  test::InputFolder folder_;
};

const std::string sides_of_pair = "[[pair]]\nfrom = \"left\"\nto = \"right\"\n";
const std::string moved_pair = sides_of_pair + "translation = [2, 0]\n";

TEST_F(PairSettings, APairIsATranslationOrARotation) {
  EXPECT_EQ(read(moved_pair).mesh.pairs, (std::vector<PeriodicPair>{{"left", "right", {2, 0}}}));
  EXPECT_EQ(read(sides_of_pair + "rotation = 30\ncentre = [1, 2]\n").mesh.pairs,
            (std::vector<PeriodicPair>{{"left", "right", {}, 30, {1, 2}}}));
  Warnings warnings;
  EXPECT_EQ(load_geometry(read(moved_pair), warnings).size(), 4);
  EXPECT_TRUE(warnings.empty());
}

TEST_F(PairSettings, WrongMapsAreRefused) {
  expect_refused(sides_of_pair, "translation");
  expect_refused(moved_pair + "rotation = 30\n", "rotation");
  expect_refused(sides_of_pair + "translation = [0, 0]\n", "is zero");
  expect_refused(sides_of_pair + "rotation = 360\n", "is a whole turn");
  expect_refused(sides_of_pair + "translation = [1.5, 0]\n", "0.5 apart");
  expect_refused("[[pair]]\nfrom = \"left\"\nto = \"left\"\ntranslation = [2, 0]\n", "name the other one");
  expect_refused("[[pair]]\nfrom = \"left\"\nto = \"rigth\"\ntranslation = [2, 0]\n", "'right'");
  expect_refused(moved_pair + "[[pair]]\nfrom = \"top\"\nto = \"left\"\nrotation = 90\n",
                 "in two tables [[pair]]");
}

TEST_F(PairSettings, WhatPairsDoNotSupportIsRefused) {
  expect_refused(moved_pair + "[boundary.left]\nbc = \"wall\"\n", "has a condition bc");
  expect_refused(moved_pair + "[boundary.right.layers]\nfirst = 0.1\ncount = 1\n", "has layers");
  expect_refused(moved_pair + "[mesh]\nmirror = \"x\"\n", "cannot have mesh.mirror");
  expect_refused(moved_pair + "[mesh]\ntype = \"metric\"\n", "cannot have mesh.type");
  expect_refused(moved_pair + "[design]\nmorph_to = 0.5\n", "cannot have design.morph_to");
}

}  // namespace
}  // namespace quadloop
