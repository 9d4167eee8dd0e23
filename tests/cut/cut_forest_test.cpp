// All leaves of a small forest against an outline: what lies in the domain is covered, once, and nothing
// else, on any number of ranks.
#include "mesher/cut/cut_forest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesher/base/ids.hpp"
#include "mesher/cut/opposed_chords.hpp"
#include "mesher/forest/refine_forest.hpp"
#include "mesher/sizes/size_cursor.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using Points = std::vector<Point>;

Geometry geometry_of(const std::vector<Points>& loops, double spacing) {
  Points points;
  std::vector<std::int32_t> starts{0};
  for (const Points& loop : loops) {
    points.insert(points.end(), loop.begin(), loop.end());
    starts.push_back(size32(points));
  }
  std::vector<BoundaryId> boundaries(points.size(), BoundaryId{0});
  return {{{"outline", spacing, 30, "wall"}}, points, starts, boundaries};
}

SizeOptions sizes_from(double min, double max, const std::vector<SizeSource>& sources) {
  SizeOptions sizes;
  sizes.sources = sources;
  sizes.min = min;
  sizes.max = max;
  return sizes;
}

double area_of(const std::vector<Points>& loops) {
  double twice = 0;
  for (const Points& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) twice += cross(loop[i], loop[(i + 1) % loop.size()]);
  }
  return 0.5 * twice;
}

/// The square of edge 8 from `low` in leaves that are no larger than 1 in the domain and about `finest` along
/// the outline, cut; all lengths but `low` times `scale`. *Collective.*
struct CutSquare {
  CutSquare(const std::vector<Points>& loops, double finest, double snap, double scale = 1,
            const std::vector<SizeSource>& sources = {}, Point low = {0, 0})
      : grid{{low, low + Point{8 * scale, 8 * scale}}, 1, 1},
        geometry{geometry_of(scaled(loops, scale), (sources.empty() ? finest : 1) * scale)},
        sizes{outline, grid, sizes_from(finest * scale, scale, sources),
              [](const Quadrant&, std::span<const std::int32_t>) { return false; }, demanded},
        graph{refine_forest(test::world(), sizes)},
        cut{cut_forest(test::world(), graph, sizes, outline, inside, snap)} {}

  template <class Visit>
  void for_leaves(const Visit& visit) const {
    for (const LeafId leaf : graph.local()) {
      const std::size_t local = graph.local_index(leaf);
      visit(grid.box_of(graph.leaf(leaf)), cut.states[local], cut.entry_of[local]);
    }
  }

  /// Of all cells of all ranks; every one is of positive area.
  double area() const {
    double own = 0;
    for_leaves([&](const Box& box, CutForest::State state, std::int32_t entry) {
      if (state == CutForest::State::inside) own += box.width() * box.width();
      if (entry >= 0) own += area_of_cells(cut.entries[entry]);
    });
    const auto all = test::world().all_gather(own);
    double sum = 0;
    for (const double part : all) sum += part;
    return sum;
  }

  double area_of_cells(const CutForest::Entry& entry) const {
    double area = 0;
    const auto add = [&](const auto& cell, std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
      const auto at = [&](std::size_t i) { return cut.nodes[entry.begin.nodes + cell[i]].position; };
      const double one = 0.5 * cross(at(b) - at(a), at(d) - at(c));
      EXPECT_GT(one, 0);
      area += one;
    };
    for (const auto& t : CutForest::part(cut.triangles, entry.begin.triangles, entry.end.triangles))
      add(t, 0, 1, 0, 2);
    for (const auto& q : CutForest::part(cut.quads, entry.begin.quads, entry.end.quads)) add(q, 0, 2, 1, 3);
    return area;
  }

  void expect_states() const {
    for_leaves([&](const Box& box, CutForest::State state, std::int32_t entry) {
      EXPECT_EQ(entry >= 0, state == CutForest::State::cut);
      if (state != CutForest::State::cut) {
        EXPECT_EQ(state == CutForest::State::inside, inside.contains(box.centre()));
      }
    });
  }

  static std::vector<Points> scaled(std::vector<Points> loops, double scale) {
    for (Points& loop : loops) {
      for (Point& p : loop) p = scale * p;
    }
    return loops;
  }

  const TreeGrid grid;
  Geometry geometry;
  ShiftedOutline outline{geometry};
  Interior inside{outline};
  DemandedSplits demanded{test::world(), {}};
  SizeTree sizes;
  LeafGraph graph;
  CutForest cut;
};

/// A tilted square with a tilted square in it.
std::vector<Points> frame() {
  return {{{4.1, 0.6}, {7.3, 3.9}, {3.9, 7.2}, {0.7, 4.2}}, {{4, 3.1}, {3.2, 3.9}, {4.1, 4.8}, {4.9, 4}}};
}

TEST(CutForest, CoversTheDomainAndNothingElse) {
  for (const double finest : {1.0, 0.25, 0.125}) {
    for (const double snap : {0.0, 0.2, 0.4}) {
      CutSquare square(frame(), finest, snap);
      EXPECT_NEAR(square.area(), area_of(frame()), 1e-13 * 64) << finest << ' ' << snap;
      square.expect_states();
      const std::int64_t moved =
          test::world().sum(std::ranges::count_if(square.cut.moved, [&](const auto& m) {
            return length(m.position - square.grid.corner(m.corner)) > 1e-9 * finest;
          }));
      EXPECT_EQ(moved > 0, snap > 0) << finest << ' ' << snap;
    }
  }
}

TEST(CutForest, KnowsTheLevelsThatAreWanted) {
  CutSquare square({{{1, 1}, {7, 1}, {7, 7}, {1, 7}}}, 0.125, 0);
  ASSERT_EQ(std::ssize(square.cut.target_levels), square.graph.local_size());
  SizeCursor cursor(square.sizes);
  for (const LeafId leaf : square.graph.local())
    EXPECT_EQ(square.cut.target_levels[square.graph.local_index(leaf)],
              cursor.target_level(square.graph.leaf(leaf)));
}

TEST(CutForest, TakesStatesFromCoarserAndFinerNeighbours) {
  // Small leaves beside the outline, which large ones hold: here to one side of it, there to the other.
  for (int trial = 0; trial < 16; ++trial) {
    std::vector<SizeSource> sources;
    for (const double x : {1.0, 3.0, 5.0, 7.0})
      sources.push_back({SizeSource::Disc{{x + 0.11 * trial, 0.5 * trial}, 0.3}, 0.0625, {}});
    CutSquare square(frame(), 0.0625, 0.4, 1, sources);
    EXPECT_NEAR(square.area(), area_of(frame()), 1e-13 * 64);
    square.expect_states();
  }
}

TEST(CutForest, AlongLatticeLines) {
  for (const double gap : {0.0, 0.5}) {
    const std::vector<Points> loops{{{1, 1}, {7, 1}, {7, 7 - gap}, {1, 7 - gap}},
                                    {{3, 3 + gap}, {3, 5}, {5 + gap, 5}, {5 + gap, 3 + gap}}};
    CutSquare square(loops, 0.25, 0.4);
    EXPECT_NEAR(square.area(), area_of(loops), 1e-13 * 64);
    square.expect_states();
  }
}

/// Round, in chords much shorter than the leaves, with a notch.
Points notched_disc() {
  Points points{{4, 4.3}};
  for (int i = 4; i <= 60; ++i) {
    const double angle = 0.1 * i;
    points.push_back({4.05 + 2.7 * std::cos(angle), 3.9 + 2.7 * std::sin(angle)});
  }
  return points;
}

TEST(CutForest, KnowsNoUnitOfLength) {
  for (const double finest : {1.0, 0.25}) {
    CutSquare square({notched_disc()}, finest, 0.4);
    for (const double scale : {0.0625, 32.0}) {
      CutSquare other({notched_disc()}, finest, 0.4, scale);
      EXPECT_EQ(other.cut.states, square.cut.states);
      EXPECT_EQ(other.cut.triangles, square.cut.triangles);
      EXPECT_EQ(other.cut.quads, square.cut.quads);
      EXPECT_EQ(other.cut.followed, square.cut.followed);
      ASSERT_EQ(other.cut.nodes.size(), square.cut.nodes.size());
      for (std::size_t n = 0; n < square.cut.nodes.size(); ++n) {
        EXPECT_EQ(other.cut.nodes[n].position, scale * square.cut.nodes[n].position);
        EXPECT_EQ(other.cut.nodes[n].site, square.cut.nodes[n].site);
      }
      ASSERT_EQ(other.cut.moved.size(), square.cut.moved.size());
      for (std::size_t i = 0; i < square.cut.moved.size(); ++i)
        EXPECT_EQ(other.cut.moved[i].position, scale * square.cut.moved[i].position);
    }
  }
}

TEST(CutForest, SnapsThatWouldSwallowAThinSpikeAreTakenBack) {
  // A spike of the domain from the left, and one of void into it: thinner than what snaps take along.
  for (int trial = 0; trial < 12; ++trial) {
    const double tip = 4 + 0.31 * trial, half = 0.02 + 0.013 * trial, y = 4 + 0.007 * trial;
    const std::vector<Points> spike{{{0.5, y - 1.5}, {2, y - half}, {tip, y}, {2, y + half}, {0.5, y + 1.5}}};
    CutSquare thin(spike, 0.5, 0.4);
    EXPECT_NEAR(thin.area(), area_of(spike), 1e-13 * 64) << trial;
    thin.expect_states();
    EXPECT_TRUE(OpposedChords(test::world(), thin.geometry, thin.graph, thin.cut).ends().empty());
    const std::vector<Points> slit{
        {{0.5, y - 3}, {7.5, y - 3}, {7.5, y + 3}, {0.5, y + 3}, {0.5, y + half}, {tip, y}, {0.5, y - half}}};
    CutSquare split(slit, 0.5, 0.4);
    EXPECT_NEAR(split.area(), area_of(slit), 1e-13 * 64) << trial;
    split.expect_states();
    EXPECT_TRUE(OpposedChords(test::world(), split.geometry, split.graph, split.cut).ends().empty());
  }
}

TEST(CutForest, WithoutSnappingATipThinnerThanRoundingStillHasOneSide) {
  // The tip of the body lies beyond a grid vertex by less than the positions of crossings can resolve.
  const double y = 1024;
  const Points body{{5e-17, y}, {-1.5, y - 2.25}, {-2, y + 0.5}};
  const std::vector<Points> loops{{{-3.5, y - 3.5}, {3.5, y - 3.5}, {3.5, y + 3.5}, {-3.5, y + 3.5}}, body};
  CutSquare square(loops, 0.25, 0, 1, {}, {-4, y - 4});
  EXPECT_TRUE(OpposedChords(test::world(), square.geometry, square.graph, square.cut).ends().empty());
  EXPECT_NEAR(square.area(), area_of(loops), 1e-12 * 64);
  square.expect_states();
}

TEST(ResolutionTest, LoopsInALeafAndStrayingChordsAskForFinerLeaves) {
  const auto unresolved = [](const std::vector<Points>& loops, const Quadrant& q) {
    const Geometry geometry = geometry_of(loops, 1);
    const ShiftedOutline outline(geometry);
    const Interior inside(outline);
    const TreeGrid grid{{{0, 0}, {8, 8}}, 1, 1};
    std::vector<std::int32_t> segments;
    for (std::int32_t s = 0; s < geometry.size(); ++s) {
      if (outline.meets(s, grid.box_of(q))) segments.push_back(s);
    }
    return ResolutionTest(grid, outline, inside).unresolved(q, segments);
  };
  const Quadrant root{0, 0, 0}, corner{0, 0, 2};
  const Points wide{{-9, 1}, {9, 1}, {9, 9}, {-9, 9}};
  EXPECT_FALSE(unresolved({wide}, root));
  EXPECT_FALSE(unresolved({wide}, corner));
  EXPECT_TRUE(unresolved({wide, {{4, 4}, {4, 5}, {5, 5}}}, root)) << "a whole loop";
  EXPECT_FALSE(unresolved({wide, {{4, 4}, {4, 5}, {5, 5}}}, corner)) << "elsewhere";
  // A shore that bends down a little, so that its chord passes above it, and a spike from above into the
  // bend.
  EXPECT_FALSE(unresolved({{{-8, 5.92}, {4, 3.04}, {16, 5.92}, {16, 12}, {-8, 12}}}, root));
  const Points spike{{-8, 5.92}, {4, 3.04}, {16, 5.92}, {16, 12}, {4.4, 12}, {4, 3.6}, {3.6, 12}, {-8, 12}};
  EXPECT_TRUE(unresolved({spike}, root)) << "chords that would cross";
  const Points short_spike{{-8, 5.92}, {4, 3.04}, {16, 5.92}, {16, 12},
                           {4.4, 12},  {4, 4.4},  {3.6, 12},  {-8, 12}};
  EXPECT_FALSE(unresolved({short_spike}, root));
}

}  // namespace
}  // namespace quadloop
