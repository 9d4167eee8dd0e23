// Chords along the two sides of a line between leaves, on one rank or on two.
#include "mesher/cut/opposed_chords.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/base/ids.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

/// An edge between two sites of a leaf that is named by its column and row.
struct LeafChord {
  std::int64_t column, row;
  Site from, to;
};

/// The square from 0 to 4 in leaves of edge 1, those in its upper right quarter of 0.5.
struct Leaves {
  static constexpr std::int64_t unit = std::int64_t{1} << (Quadrant::unit_level - 2);

  Forest forest() const {
    Forest forest(test::world(), grid);
    forest.refine([](const Quadrant& q) { return q.level < 2 || (q.x >= 2 * unit && q.y >= 2 * unit); }, 3);
    forest.partition();
    return forest;
  }

  /// The ends that this rank is told where these are all chords.
  std::vector<Point> ends_with(const std::vector<LeafChord>& chords) const {
    CutForest cut;
    for (const LeafId leaf : graph.local()) {
      const Quadrant& q = graph.leaf(leaf);
      cut.entry_of.push_back(-1);
      for (const LeafChord& chord : chords) {
        if (q.x != chord.column * unit || q.y != chord.row * unit) continue;
        if (cut.entry_of.back() < 0) {
          cut.entry_of.back() = size32(cut.entries);
          cut.entries.push_back({{size32(cut.nodes), 0, 0, size32(cut.outline)}, {}, {}});
        }
        const std::int32_t first = size32(cut.nodes) - cut.entries.back().begin.nodes;
        for (const Site site : {chord.from, chord.to}) {
          const GridPoint at = q.at(site);
          cut.nodes.push_back({grid.corner(at.x, at.y), site});
        }
        cut.outline.push_back({first, first + 1, 0});
        cut.entries.back().end = {size32(cut.nodes), 0, 0, size32(cut.outline)};
      }
    }
    return OpposedChords(test::world(), Geometry({}, {}, {0}, {}), graph, cut).ends();
  }

  bool owns(std::int64_t column, std::int64_t row) const {
    return graph.rank_at(column * unit, row * unit) == test::world().rank();
  }

  const TreeGrid grid{{{0, 0}, {4, 4}}, 1, 1};
  LeafGraph graph{test::world(), grid, forest()};
};

Site end_site(Side side) { return start_of(next(side)); }

TEST(OpposedChords, AreFoundAcrossEverySide) {
  const Leaves leaves;
  const std::array<std::array<std::int64_t, 2>, 4> steps{{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
  int pairs = 0;
  for (std::int64_t column = 0; column < 4; ++column) {
    for (std::int64_t row = 0; row < 4; ++row) {
      for (const Side side : all_sides) {
        const auto [dx, dy] = steps[index_of(side)];
        const std::int64_t x = column + dx, y = row + dy;
        const auto is_one = [](std::int64_t a, std::int64_t b) {
          return a >= 0 && b >= 0 && a < 4 && b < 4 && (a < 2 || b < 2);
        };
        if (!is_one(column, row) || !is_one(x, y)) continue;
        ++pairs;
        const LeafChord chord{column, row, start_of(side), end_site(side)};
        const LeafChord against{x, y, start_of(opposite(side)), end_site(opposite(side))};
        const LeafChord along{x, y, end_site(opposite(side)), start_of(opposite(side))};
        const auto ends = leaves.ends_with({chord, against});
        if (leaves.owns(column, row) || leaves.owns(x, y)) {
          EXPECT_EQ(ends.size(), 2U) << column << ' ' << row << ' ' << index_of(side);
          EXPECT_TRUE(std::is_sorted(ends.begin(), ends.end()));
        } else {
          EXPECT_TRUE(ends.empty());
        }
        EXPECT_TRUE(leaves.ends_with({chord, along}).empty()) << "the same way";
        EXPECT_TRUE(leaves.ends_with({chord}).empty()) << "alone";
      }
    }
  }
  EXPECT_EQ(pairs, 2 * 16) << "twelve squares have 16 common sides";
}

TEST(OpposedChords, TheirEndsAreToldOnce) {
  const Leaves leaves;
  using enum Site;
  const std::vector<LeafChord> chords{{0, 0, north_east, north_west},
                                      {0, 1, south_west, south_east},
                                      {1, 0, north_east, north_west},
                                      {1, 1, south_west, south_east}};
  const auto ends = leaves.ends_with(chords);
  if (leaves.owns(0, 0) && leaves.owns(1, 0)) {
    EXPECT_EQ(ends, (std::vector<Point>{{0, 1}, {1, 1}, {2, 1}}));
  }
}

TEST(OpposedChords, OnlyWhatLiesOnOneSideFromEndToEndCounts) {
  const Leaves leaves;
  using enum Site;
  EXPECT_TRUE(leaves.ends_with({{0, 0, south_west, north_east}, {0, 0, north_east, south_west}}).empty())
      << "through a leaf";
  EXPECT_TRUE(leaves.ends_with({{0, 0, north_east, north_west}, {0, 1, south_west, bottom_middle}}).empty())
      << "half of the side";
  EXPECT_TRUE(leaves.ends_with({{0, 0, north_east, north_west}, {0, 1, bottom_middle, south_east}}).empty())
      << "the other half";
}

}  // namespace
}  // namespace quadloop
