#include "io/dxf/dxf_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>

#include "mesher/geometry/assemble/assemble.hpp"
#include "tests/io/dxf/dxf_entities.hpp"

namespace quadloop::io {
namespace {

using namespace test;

class DxfReader : public DxfTest {
 protected:
  void expect_warning(const std::string& piece) {
    ASSERT_EQ(warnings_.size(), 1u);
    EXPECT_NE(warnings_[0].find(piece), std::string::npos) << piece << " in " << warnings_[0];
  }
};

/// A drawing with a header, and a layer "old" that is frozen.
std::string drawing_of(const std::string& entities) {
  return section("HEADER", groups(9, "$ACADVER", 1, "AC1015", 9, "$INSUNITS", 70, 4)) +
         table_of_layers(layer_entry("old", 1, 7)) + dxf_of(entities);
}

/// A drawing with layers "wall", "old" (frozen) and "dark" (off), a block "Hole" and the entities.
std::string drawing_with_block(const std::string& content, const std::string& entities) {
  return section("HEADER", groups(9, "$ACADVER", 1, "AC1015")) +
         table_of_layers(layer_entry("wall", 0, 7) + layer_entry("old", 1, 7) + layer_entry("dark", 0, -7)) +
         section("BLOCKS", block_of("Hole", content)) + dxf_of(entities);
}

const std::string at_three = groups(10, 3, 20, 3);

TEST_F(DxfReader, RefusesADrawingThatEndsWithinASection) {
  const std::string open = groups(0, "SECTION", 2, "ENTITIES") + dxf_line("0", 0, 0, 1, 1);
  EXPECT_EQ(refused(open + groups(0, "EOF")).find("a.dxf:21: section ENTITIES does not end with ENDSEC"), 0u)
      << refused(open + groups(0, "EOF"));
  EXPECT_NE(refused(open + section("OBJECTS", "")).find("does not end"), std::string::npos);
  EXPECT_NE(refused(open).find("a.dxf:21: section ENTITIES does not end"), std::string::npos);
  EXPECT_NE(refused(open + "  0\nENDSEC\nzero\nEOF\n").find("a.dxf:23: a group code is expected"),
            std::string::npos);
  EXPECT_NE(refused("2\n0\n").find("a.dxf:3: there is no SECTION"), std::string::npos) << refused("2\n0\n");
  EXPECT_EQ(read(open + groups(0, "ENDSEC")).size(), 1u);
}

TEST_F(DxfReader, ReadsLinesByLayer) {
  const auto chains = read(
      dxf_of(dxf_line("wall", 0, 0, 1, 0) + dxf_line("wall", 1, 1, 1, 0) + dxf_line("inlet", 0, 0, 1, 1)));
  ASSERT_EQ(chains.size(), 3u);
  EXPECT_EQ(chains[0].name, "wall");
  EXPECT_EQ(chains[2].name, "inlet");
  Warnings warnings;
  const Geometry geometry = assemble(chains, {}, warnings);
  EXPECT_EQ(geometry.size(), 3);
  EXPECT_EQ(geometry.boundaries().size(), 2u);
}

TEST_F(DxfReader, TakesWhatOtherProgramsWrite) {
  std::string text =
      "\xEF\xBB\xBF" + groups(999, "written by hand") +
      dxf_of(groups(0, "LINE", 8, "wall 1,a", 10, "+1.5D0", 20, " 2. ", 11, ".5e+01", 21, "1e-400"));
  for (const char* const end : {"\r\n", "\r"}) {
    std::string ends;
    for (const char c : text) ends += c == '\n' ? std::string(end) : std::string(1, c);
    const auto chains = read(ends);
    ASSERT_EQ(chains.size(), 1u);
    EXPECT_EQ(chains[0].name, "wall_1_a");
    EXPECT_EQ(chains[0].points, (std::vector<Point>{{1.5, 2}, {5, 0}}));
  }
}

TEST_F(DxfReader, DoesNotDependOnTheLocale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "no locale with decimal commas here";
  const auto chains = read(dxf_of(dxf_line("wall", 0.5, 0, 1, 0.25)));
  std::setlocale(LC_ALL, before.c_str());
  EXPECT_EQ(chains.at(0).points, (std::vector<Point>{{0.5, 0}, {1, 0.25}}));
}

TEST_F(DxfReader, NamesPlaceLayerAndHandleOfWhatIsWrong) {
  const std::string line = entity("LINE", "1F2A3B4C5D", groups(8, "rim", 10, 0, 20, "abc"));
  const std::string said = refused(drawing_of(line));
  EXPECT_NE(said.find("a.dxf:43: layer 'rim', LINE of handle 1F2A3B4C5D: 'abc' of group 20 is not a finite"),
            std::string::npos)
      << said;
  for (const char* const bad : {"1,5", "nan", "1e999", ""}) {
    EXPECT_NE(refused(dxf_of(groups(0, "LINE", 8, "rim", 10, bad))).find("LINE without handle: '"),
              std::string::npos)
        << bad;
  }
  EXPECT_NE(refused(dxf_of(groups(0, "CIRCLE", 10, 1, 40, -2)))
                .find("layer '0', CIRCLE without handle: its "
                      "radius is negative"),
            std::string::npos);
  EXPECT_NE(refused("AutoCAD Binary DXF\r\n\x1a").find("binary DXF"), std::string::npos);
}

TEST_F(DxfReader, TellsTheUnitThatAFileDeclares) {
  read(drawing_of(dxf_circle("A1", "wall", 4)));
  EXPECT_EQ(unit_.name, "mm");
  EXPECT_EQ(unit_.layers, (std::vector<std::string>{"old", "wall"}));
  read(dxf_of(dxf_circle("A1", "wall", 4)));
  EXPECT_EQ(unit_.name, "");
}

TEST_F(DxfReader, LeavesOutWhatIsNotSeenOrNoOutline) {
  const auto chains = read(drawing_of(
      dxf_circle("A1", "wall", 4) + dxf_circle("A2", "old", 2) + dxf_circle("A3", "wall", 3, groups(67, 1)) +
      dxf_circle("A7", "wall", 1, groups(60, 1)) + entity("POINT", "A4", groups(8, "wall", 10, 1, 20, 1)) +
      entity("TEXT", "A5", groups(8, "notes", 10, 1, 20, 1, 40, 1, 1, "hello")) +
      entity("SOLID", "A6", groups(8, "notes", 10, 0, 20, 0, 11, 1, 21, 0)) + dxf_line("wall", 1, 1, 1, 1) +
      groups(0, "POLYLINE", 8, "net", 66, 1, 70, 16) + groups(0, "VERTEX", 8, "net", 10, 1, 20, 2) +
      groups(0, "SEQEND", 8, "net")));
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].name, "wall");
  EXPECT_NEAR(length(chains[0].points[0]), 4, 1e-12);
  EXPECT_EQ(warnings_,
            std::vector<std::string>{
                (folder_.path() / "a.dxf").string() +
                ": left out: 1 CIRCLE in paper space, 1 CIRCLE not visible on layer 'old', 1 CIRCLE "
                "not visible on layer 'wall', 1 LINE without extent on layer 'wall', 1 POINT on layer "
                "'wall', 1 POLYLINE on layer 'net', 1 SOLID on layer 'notes', 1 TEXT on layer 'notes'"});
}

TEST_F(DxfReader, ReadsTheLayersThatAreNamed) {
  const std::string text = drawing_of(dxf_circle("A1", "wall", 4) + dxf_circle("A2", "old", 2));
  choice_.layers = {"o*"};
  const auto chains = read(text);
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].name, "old");
  EXPECT_TRUE(warnings_.empty());
  choice_.layers = {"walls", "in?"};
  const std::string said = refused(text);
  EXPECT_NE(said.find("one of [walls, in?]; its layers are: old, wall"), std::string::npos) << said;
}

TEST_F(DxfReader, NamesWhatAFileWithoutOutlinesHas) {
  const std::string said = refused(drawing_of(dxf_circle("A2", "old", 2)));
  EXPECT_NE(
      said.find("holds no lines and no polygons; a geometry needs closed outlines. Left out: 1 CIRCLE not"),
      std::string::npos)
      << said;
}

TEST_F(DxfReader, LayersWithinABlockAreHiddenAsElsewhere) {
  const std::string content = dxf_square("wall", 0, 2) + dxf_square("old", 3, 1) + dxf_square("dark", 5, 1);
  const std::string text = drawing_with_block(content, insert_of("Hole", "wall", at_three));
  const auto chains = read(text);
  ASSERT_EQ(chains.size(), 4u);
  for (const Chain& chain : chains) {
    EXPECT_EQ(chain.name, "wall");
    EXPECT_LE(chain.points[0].x, 5) << "3 for the place of the block, and 2";
  }
  expect_warning("4 LINE not visible on layer 'dark', 4 LINE not visible on layer 'old'");
  choice_.layers = {"old"};
  EXPECT_EQ(read(text).size(), 4u);
}

TEST_F(DxfReader, AReferenceThatIsNotVisibleHidesItsBlock) {
  const std::string frozen = insert_of("Hole", "old", at_three),
                    off = insert_of("Hole", "dark", groups(10, 9)),
                    content = dxf_square("wall", 0, 2) + dxf_line("0", 0, 0, 1, 0);
  EXPECT_EQ(read(drawing_with_block(content, off)).size(), 4u) << "what is on layer 0 is off";
  expect_warning("1 LINE not visible on layer 'dark'");
  EXPECT_NE(refused(drawing_with_block(content, frozen)).find("4 LINE not visible on layer 'wall'"),
            std::string::npos);
  EXPECT_NE(refused(drawing_with_block(content, insert_of("Hole", "wall", groups(67, 1))))
                .find("1 INSERT in "
                      "paper space"),
            std::string::npos);
}

TEST_F(DxfReader, ReadsBlocksOfDrawingsWithClasses) {
  const auto chains =
      read(drawing_with_block(dxf_square("0", 0, 2), groups(0, "INSERT", 100, "AcDbEntity", 8, "wall", 100,
                                                            "AcDbBlockReference", 2, "Hole", 10, 3, 20, 3)));
  ASSERT_EQ(chains.size(), 4u);
  EXPECT_EQ(chains[0].name, "wall") << "what is on layer 0 of a block takes the layer of the reference";
  EXPECT_TRUE(warnings_.empty()) << warnings_.front();
}

TEST_F(DxfReader, NamesOfADrawingHaveNoCase) {
  const auto chains = read(drawing_with_block(
      dxf_square("0", 0, 2), insert_of("HOLE", "Wall", at_three) + dxf_circle("A1", "OLD", 1)));
  ASSERT_EQ(chains.size(), 4u);
  EXPECT_EQ(chains[0].name, "wall");
  expect_warning("1 CIRCLE not visible on layer 'old'");
  choice_.layers = {"OLD"};
  EXPECT_EQ(read(drawing_of(dxf_circle("A1", "old", 1))).size(), 1u);
}

TEST_F(DxfReader, WarnsOfReferencesToMissingBlocks) {
  read(drawing_with_block("", insert_of("nope", "wall", at_three) + dxf_square("wall", 0, 1)));
  expect_warning("1 INSERT of block 'nope', whose content is not in the file");
}

TEST_F(DxfReader, PlacesBlocksByOffsetScaleAndRotation) {
  const std::string blocks =
      section("BLOCKS", block_of("arrow", dxf_line("0", 1, 1, 3, 2), 1, 1));  // from the base point by (2, 1)
  const auto chains =
      read(blocks + dxf_of(insert_of("ARROW", "a", groups(10, 10, 20, 20, 41, -2, 42, 3, 50, 90))));
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].points, (std::vector<Point>{{10, 20}, {10 - 3, 20 - 4}}));
}

TEST_F(DxfReader, RepeatsBlocksInColumnsAndRows) {
  const std::string blocks = section("BLOCKS", block_of("dash", dxf_line("0", 0, 0, 1, 0)));
  const auto chains =
      read(blocks + dxf_of(insert_of("dash", "a", groups(41, 2, 50, 90, 70, 3, 71, 2, 44, 10, 45, 100))));
  ASSERT_EQ(chains.size(), 6u);
  EXPECT_EQ(chains[0].points, (std::vector<Point>{{0, 0}, {0, 2}}));
  EXPECT_EQ(chains[2].points, (std::vector<Point>{{0, 20}, {0, 22}})) << "spacings turn, but do not scale";
  EXPECT_EQ(chains[3].points, (std::vector<Point>{{-100, 0}, {-100, 2}}));
}

TEST_F(DxfReader, PlacesBlocksWithinBlocks) {
  const std::string blocks =
      section("BLOCKS", block_of("inner", dxf_line("0", 1, 0, 2, 0)) +
                            block_of("outer", insert_of("inner", "0", groups(10, 5, 20, 0, 50, 90))));
  const auto chains = read(blocks + dxf_of(insert_of("outer", "wall", groups(10, 100, 20, 0, 41, -1))));
  ASSERT_EQ(chains.size(), 1u);
  EXPECT_EQ(chains[0].name, "wall");
  EXPECT_EQ(chains[0].points, (std::vector<Point>{{95, 1}, {95, 2}}));
}

TEST_F(DxfReader, RefusesBlocksWithoutEnd) {
  const std::string self =
      section("BLOCKS", block_of("a", insert_of("b", "0", "")) +
                            block_of("b", insert_of("A", "0", "") + dxf_line("0", 0, 0, 1, 0)));
  EXPECT_NE(
      refused(self + dxf_of(insert_of("a", "w", ""))).find("it inserts block 'a', which contains itself"),
      std::string::npos);
  const std::string wide = section("BLOCKS", block_of("a", dxf_line("0", 0, 0, 1, 0)));
  EXPECT_NE(refused(wide + dxf_of(insert_of("a", "w", groups(70, 2000000000, 71, 2000000000))))
                .find("more than a million"),
            std::string::npos);
  std::string deep = block_of("b0", dxf_line("0", 0, 0, 1, 0));
  for (int i = 1; i < 30; ++i) {
    const std::string below = insert_of(fmt::format("b{}", i - 1), "0", "");
    deep += block_of(fmt::format("b{}", i), below + below);
  }
  EXPECT_NE(refused(section("BLOCKS", deep) + dxf_of(insert_of("b29", "w", ""))).find("more than a million"),
            std::string::npos);
}

TEST_F(DxfReader, NamesBoundariesByBlockColourOrFile) {
  const std::string text =
      table_of_layers(layer_entry("wall", 0, 3)) +
      section("BLOCKS", block_of("Hole 1", groups(0, "LINE", 8, "wall", 62, 0, 11, 1) +      // of its block
                                               groups(0, "LINE", 8, "wall", 62, 9, 11, 2) +  // index
                                               dxf_line("wall", 0, 0, 3, 0))) +
      dxf_of(insert_of("Hole 1", "wall", groups(62, 1)) + dxf_line("wall", 5, 0, 6, 0) +
             groups(0, "LINE", 8, "wall", 62, 5, 420, 16744448, 11, 7));
  using From = BoundaryNames::From;
  const auto names = [&](From from) {
    choice_.names = {from};
    std::vector<std::string> found;
    for (const Chain& chain : read("cut.dxf", text)) found.push_back(chain.name);
    return fmt::format("{}", fmt::join(found, " "));
  };
  EXPECT_EQ(names(From::usual), "wall wall wall wall wall");
  EXPECT_EQ(names(From::layer), "wall wall wall wall wall");
  EXPECT_EQ(names(From::block), "Hole_1 Hole_1 Hole_1 wall wall");
  EXPECT_EQ(names(From::colour), "red colour_9 green green colour_ff8000");
  EXPECT_EQ(names(From::file), "cut cut cut cut cut");
}

TEST_F(DxfReader, ReadsADrawingThatBeginsWithItsBlocks) {
  const auto chains =
      read(section("BLOCKS", "") + dxf_of(dxf_line("0", 0, 0, 1, 0) + dxf_line("0", 1, 0, 0, 1)));
  EXPECT_EQ(chains.size(), 2u);
  EXPECT_NE(refused(section("ENTITIES", dxf_line("0", 0, 0, 1, 0)) + dxf_of(dxf_line("0", 0, 0, 1, 0)))
                .find("the second one"),
            std::string::npos);
}

void expect_joined(const std::vector<Chain>& chains, std::size_t boundaries) {
  Warnings warnings;
  const Geometry geometry = assemble(chains, {}, warnings);
  ASSERT_EQ(geometry.loop_count(), 1);
  EXPECT_EQ(geometry.boundaries().size(), boundaries);
  for (std::int32_t v = 0; v < geometry.size(); ++v)
    EXPECT_GT(length(geometry.point(geometry.next(v)) - geometry.point(v)), 1e-3);
  EXPECT_TRUE(std::ranges::any_of(warnings, [](const std::string& w) {
    return w.find("no farther apart than") < w.size();
  })) << fmt::format("{}", fmt::join(warnings, "; "));
}

TEST_F(DxfReader, JoinsArcsWhoseEndsDifferByRounding) {
  expect_joined(read(dxf_of(dxf_line("wall", 0.1, 0.3, 2.1, 0.3) + dxf_arc("end", 2.1, 0.8, 0.5, 270, 90) +
                            dxf_line("wall", 2.1, 1.3, 0.1, 1.3) + dxf_arc("end", 0.1, 0.8, 0.5, 90, 270))),
                2);
}

}  // namespace
}  // namespace quadloop::io
