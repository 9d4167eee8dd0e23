// What a cut leaf is tested with before it is believed: whether loops and sides are simple and nested.
#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/base/ids.hpp"
#include "mesher/cut/cut_leaf.hpp"

namespace quadloop {
namespace {

using Loop = std::vector<std::int32_t>;
using Edges = std::vector<CutLeaf::Edge>;

CutLeaf leaf_of(const std::vector<Point>& places, const std::vector<Loop>& loops) {
  CutLeaf leaf;
  for (const Point p : places) leaf.nodes.push_back({p, Site::inside});
  leaf.loop_starts.assign(1, 0);
  for (const Loop& loop : loops) {
    leaf.loop_nodes.insert(leaf.loop_nodes.end(), loop.begin(), loop.end());
    leaf.loop_starts.push_back(size32(leaf.loop_nodes));
  }
  leaf.loop_blocks.assign(loops.size(), 0);
  return leaf;
}

Edges edges_of(const Loop& loop) {
  Edges edges;
  for (std::size_t i = 0; i < loop.size(); ++i) edges.push_back({loop[i], loop[(i + 1) % loop.size()], -1});
  return edges;
}

/// Whether the loops over these places are sound, which must not depend on the order of edges or loops, nor
/// on which way the leaf lies.
bool sound(std::vector<Point> places, std::vector<Loop> loops) {
  Edges edges;
  for (const Loop& loop : loops) {
    const Edges more = edges_of(loop);
    edges.insert(edges.end(), more.begin(), more.end());
  }
  const bool answer = loops_are_sound(edges, leaf_of(places, loops));
  for (std::size_t turn = 0; turn < std::max<std::size_t>(4, edges.size()); ++turn) {
    for (Point& p : places) p = {-p.y, p.x};
    std::rotate(edges.begin(), edges.begin() + 1, edges.end());
    std::rotate(loops.begin(), loops.begin() + 1, loops.end());
    EXPECT_EQ(loops_are_sound(edges, leaf_of(places, loops)), answer) << "turn " << turn;
    std::reverse(edges.begin(), edges.end());
    EXPECT_EQ(loops_are_sound(edges, leaf_of(places, loops)), answer) << "turn " << turn << ", reversed";
    std::reverse(edges.begin(), edges.end());
  }
  return answer;
}

const std::vector<Point> squares{{0, 0},     {8, 0},     {8, 8},     {0, 8},  // 0 to 3
                                 {1, 1},     {7, 1},     {7, 7},     {1, 7},  // 4 to 7
                                 {2, 2},     {6, 2},     {6, 6},     {2, 6},  // 8 to 11
                                 {9, 2},     {12, 2},    {12, 6},    {9, 6},  // 12 to 15: beside the first
                                 {8.5, 0.5}, {8.5, 1.5}, {9.5, 1.5}, {9.5, 0.5}};  // clockwise

TEST(LoopsAreSound, ABlockMayFillAHoleOfAnother) {
  const Loop outer{0, 1, 2, 3}, hole{7, 6, 5, 4}, filling{4, 5, 6, 7};
  CutLeaf leaf = leaf_of(squares, {outer, hole, filling});
  Edges edges = edges_of(outer);
  for (const Loop& loop : {hole, filling}) {
    const Edges more = edges_of(loop);
    edges.insert(edges.end(), more.begin(), more.end());
  }
  EXPECT_FALSE(loops_are_sound(edges, leaf)) << "opposite edges of one block";
  leaf.loop_blocks = {0, 0, 1};
  for (std::size_t e = 8; e < edges.size(); ++e) edges[e].block = 1;
  EXPECT_TRUE(loops_are_sound(edges, leaf));
  leaf.loop_blocks = {0, 1, 1};
  for (std::size_t e = 4; e < 8; ++e) edges[e].block = 1;
  EXPECT_FALSE(loops_are_sound(edges, leaf)) << "a hole of the wrong block";
}

TEST(LoopsAreSound, OutlinesAndHolesLieInTurnInEachOther) {
  const Loop outer{0, 1, 2, 3}, middle{4, 5, 6, 7}, inner{8, 9, 10, 11};
  const Loop outer_hole{0, 3, 2, 1}, hole{4, 7, 6, 5}, inner_hole{8, 11, 10, 9};
  EXPECT_TRUE(sound(squares, {outer}));
  EXPECT_TRUE(sound(squares, {outer, hole}));
  EXPECT_TRUE(sound(squares, {outer, hole, inner}));
  EXPECT_TRUE(sound(squares, {outer, {12, 13, 14, 15}})) << "side by side";
  EXPECT_FALSE(sound(squares, {outer_hole})) << "a hole in nothing";
  EXPECT_FALSE(sound(squares, {outer, middle})) << "an outline in an outline";
  EXPECT_FALSE(sound(squares, {outer, hole, inner_hole})) << "a hole in a hole";
  EXPECT_FALSE(sound(squares, {outer, {16, 17, 18, 19}})) << "a hole beside";
  EXPECT_FALSE(sound(squares, {outer, {12, 15, 14, 13}})) << "a hole at the same height";
}

TEST(LoopsAreSound, ALoopOfWhichEveryNodeIsANodeOfAnother) {
  const std::vector<Point> bulging{{0, 0}, {12, 0}, {12, 12}, {0, 12}, {6, 9},
                                   {9, 8}, {8, 4},  {6, 2},   {4, 4},  {3, 8}};
  const Loop box{0, 1, 2, 3}, hole{4, 5, 6, 7, 8, 9};
  EXPECT_TRUE(sound(bulging, {box, hole, {4, 8, 6}})) << "a pocket between bodies that touch";
  EXPECT_FALSE(sound(bulging, {box, hole, {4, 6, 8}})) << "a hole in a hole";
  EXPECT_FALSE(sound(bulging, {box, {4, 9, 8, 7, 6, 5}, {4, 8, 6}})) << "outlines in an outline";
  const std::vector<Point> star{{0, 0}, {12, 0}, {12, 12}, {0, 12}, {6, 11},
                                {7, 6}, {11, 2}, {6, 4},   {1, 2},  {5, 6}};
  EXPECT_TRUE(sound(star, {{4, 8, 6}, hole})) << "a body that touches the outline with its tips";
  EXPECT_FALSE(sound(star, {box, {4, 8, 6}, hole})) << "the same within an outline";
  EXPECT_FALSE(sound(star, {{4, 6, 8}, {4, 9, 8, 7, 6, 5}})) << "an outline in a hole in nothing";
}

TEST(LoopsAreSound, ALoopAtANodeOfAnother) {
  const std::vector<Point> places{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 2}, {2, 1}, {-1, -2}, {-2, -1}};
  EXPECT_TRUE(sound(places, {{0, 1, 2, 3}, {0, 4, 5}})) << "a hole that hangs inside";
  EXPECT_FALSE(sound(places, {{0, 1, 2, 3}, {0, 5, 4}})) << "an outline inside";
  EXPECT_TRUE(sound(places, {{0, 1, 2, 3}, {0, 7, 6}})) << "an outline that hangs outside";
  EXPECT_FALSE(sound(places, {{0, 1, 2, 3}, {0, 6, 7}})) << "a hole outside";
}

TEST(LoopsAreSound, NoTwoEdgesMeetButAtTheirEnds) {
  const std::vector<Point> places{{0, 0}, {2, 0}, {4, 0}, {4, 4}, {0, 4}, {2, 2}, {2, 4}, {6, 0}};
  EXPECT_TRUE(sound(places, {{0, 1, 2, 3, 4}})) << "straight on is no fold";
  EXPECT_TRUE(sound(places, {{0, 2, 3, 5, 4}})) << "a bay";
  EXPECT_FALSE(sound(places, {{0, 3, 2, 4}})) << "crossing";
  EXPECT_FALSE(sound(places, {{0, 2, 3, 1, 4}})) << "a node on an edge";
  EXPECT_FALSE(sound(places, {{0, 2, 3, 6, 1, 4}})) << "a node on an edge, from inside";
  EXPECT_FALSE(sound(places, {{0, 7, 2, 3, 4}})) << "back along an edge, not so far";
  EXPECT_FALSE(sound(places, {{0, 1, 0, 2, 3, 4}})) << "forth and back, and further";
  EXPECT_FALSE(sound(places, {{0, 2, 3, 4}, {0, 1, 3, 4}})) << "edges on one line from one node";
  EXPECT_FALSE(sound(places, {{0, 2, 3, 4}, {1, 2, 3, 4}})) << "and to one node";
  EXPECT_FALSE(sound(places, {{0, 1}})) << "two nodes are no loop";
}

TEST(WindingOf, IsThatOfTheWholeLoopWhereverItBegins) {
  const std::vector<Point> places{
      {0, 0}, {4, -4}, {1, 0}, {4, 4}};  // the second from the left turns the other way
  Loop loop{0, 1, 2, 3};
  for (std::size_t first = 0; first < loop.size(); ++first) {
    std::rotate(loop.begin(), loop.begin() + 1, loop.end());
    const Loop back(loop.rbegin(), loop.rend());
    EXPECT_EQ(winding_of(leaf_of(places, {}), loop), 1);
    EXPECT_EQ(winding_of(leaf_of(places, {}), back), -1);
  }
}

/// The loops that are traced from the edges of these ones, each from its least node on, in order.
std::vector<Loop> traced(const std::vector<Point>& places, const Edges& edges) {
  CutLeaf leaf = leaf_of(places, {});
  EXPECT_TRUE(trace_loops(edges, leaf));
  std::vector<Loop> loops;
  for (std::size_t i = 0; i < leaf.loop_count(); ++i) {
    Loop loop(leaf.loop(i).begin(), leaf.loop(i).end());
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    loops.push_back(loop);
  }
  std::sort(loops.begin(), loops.end());
  return loops;
}

TEST(TraceTouchingLoops, OfAllWaysOnTheSharpestTurnLeftIsTaken) {
  // Three slices one above another that meet at both ends, and a triangle at each end, whose sides go
  // straight on: a wrong turn would join two slices to an outline with a hole.
  std::vector<Point> places{{-4, 0}, {4, 0},  {0, 4},  {0, 5}, {0, -1}, {0, 1},
                            {0, -5}, {0, -4}, {8, -4}, {8, 4}, {-8, 4}, {-8, -4}};
  const std::vector<Loop> loops{{0, 2, 1, 3}, {0, 4, 1, 5}, {0, 6, 1, 7}, {0, 10, 11}, {1, 8, 9}};
  Edges edges;
  for (const Loop& loop : loops) {
    const Edges more = edges_of(loop);
    edges.insert(edges.end(), more.begin(), more.end());
  }
  for (std::size_t turn = 0; turn < edges.size(); ++turn) {
    EXPECT_EQ(traced(places, edges), loops) << "turn " << turn;
    EXPECT_EQ(traced(places, Edges(edges.rbegin(), edges.rend())), loops) << "turn " << turn << ", reversed";
    for (Point& p : places) p = {-p.y, p.x};
    std::rotate(edges.begin(), edges.begin() + 1, edges.end());
  }
}

/// A leaf of the unit square that a chord across cuts, the domain above: its nodes round the sides.
struct CutSquare {
  std::vector<Point> places{{0, 0}, {1, 0}, {1, 0.5}, {1, 1}, {0, 1}, {0, 0.5}};
  std::int32_t side_nodes = 6;
  Edges outline{{5, 2, 0}}, edges{{5, 2, 0}, {2, 3, -1}, {3, 4, -1}, {4, 5, -1}};
  Edges bare_sides{{5, 0, -1}, {0, 1, -1}, {1, 2, -1}};

  /// It must not depend on the order of the sides.
  bool is_sound() const {
    CutLeaf leaf = leaf_of(places, {});
    leaf.side_nodes = side_nodes;
    leaf.outline = outline;
    const bool answer = sides_are_sound(edges, bare_sides, leaf);
    Edges sides = bare_sides;
    for (std::size_t turn = 0; turn < sides.size(); ++turn) {
      std::rotate(sides.begin(), sides.begin() + 1, sides.end());
      EXPECT_EQ(sides_are_sound(edges, sides, leaf), answer) << "turn " << turn;
    }
    return answer;
  }
};

TEST(SidesAreSound, ACornerMayMoveUntilItsSidesMeetAnother) {
  CutSquare square;
  EXPECT_TRUE(square.is_sound());
  square.places[0] = {0.5, 0.4};
  EXPECT_TRUE(square.is_sound());
  square.places[0] = {0.5, 0.6};
  EXPECT_FALSE(square.is_sound()) << "beyond the chord";
  square = {};
  square.places[0] = {1.5, 0.25};
  EXPECT_FALSE(square.is_sound()) << "beyond the side across";
}

TEST(SidesAreSound, AChordMayLieOnASideAndNotOutsideOfTheLeaf) {
  CutSquare square;
  square.places[2] = {0.6, 0.5};  // the sides bend in there, which the chord passes outside
  square.outline = {{1, 3, 0}};
  square.edges = {{1, 3, 0}, {3, 4, -1}, {4, 5, -1}, {5, 0, -1}, {0, 1, -1}};
  square.bare_sides = {{1, 2, -1}, {2, 3, -1}};
  EXPECT_FALSE(square.is_sound());
  square.places[2] = {1.4, 0.5};
  EXPECT_TRUE(square.is_sound()) << "they bend out";
  square.outline = {{1, 2, 0}, {2, 3, 0}};
  square.edges = {{1, 2, 0}, {2, 3, 0}, {3, 4, -1}, {4, 5, -1}, {5, 0, -1}, {0, 1, -1}};
  EXPECT_TRUE(square.is_sound()) << "along the side";
  square.outline = {{2, 1, 0}, {3, 2, 0}};
  square.edges = {{2, 1, 0}, {3, 2, 0}};
  EXPECT_TRUE(square.is_sound()) << "along it, for a neighbour's cells";
}

TEST(SidesAreSound, AChordThatLiesOnPartOfABareSideIsNone) {
  CutSquare square;
  square.places.push_back({0.5, 0});  // inside, says its number; in fact on the lower side
  for (const CutLeaf::Edge chord : {CutLeaf::Edge{0, 6, 0}, {6, 0, 0}, {6, 1, 0}, {1, 6, 0}}) {
    square.edges.push_back(chord);
    EXPECT_FALSE(square.is_sound());
    square.edges.pop_back();
  }
}

TEST(SidesAreSound, InnerNodesLieInside) {
  CutSquare square;
  square.places.push_back({0.5, 0.75});
  square.outline = {{5, 6, 0}, {6, 2, 0}};
  square.edges = {{5, 6, 0}, {6, 2, 0}, {2, 3, -1}, {3, 4, -1}, {4, 5, -1}};
  EXPECT_TRUE(square.is_sound());
  square.places[0] = {0.5, 0.6};
  EXPECT_TRUE(square.is_sound()) << "a corner short of the node";
  square.places[0] = {0.5, 0.9};
  EXPECT_FALSE(square.is_sound()) << "and beyond it";
  square.places[0] = {0, 0};
  square.places.push_back({2, 2});  // a loop's node that no edge ties to the sides
  EXPECT_FALSE(square.is_sound());
}

TEST(SidesAreSound, TheSidesRunCounterClockwise) {
  CutSquare square;
  square.outline = square.edges = square.bare_sides = {};
  EXPECT_TRUE(square.is_sound());
  for (Point& p : square.places) p = {p.y, p.x};
  EXPECT_FALSE(square.is_sound());
}

}  // namespace
}  // namespace quadloop
