// The outline inside leaves: cut at their sides, with nothing lost between them.
#include "mesher/snap/leaf_trace.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "tests/snap/traced_leaves.hpp"

namespace quadloop {
namespace {

/// The outline in the unit square.
struct Traced {
  explicit Traced(const std::vector<Point>& loop, const Box& box = {{0, 0}, {1, 1}})
      : geometry{test::loops_of({loop})} {
    std::vector<std::int32_t> segments;
    for (std::int32_t s = 0; s < geometry.size(); ++s) {
      if (outline.meets(s, box)) segments.push_back(s);
    }
    traces.add(outline, box, segments);
  }
  LeafTrace trace() const { return traces[0]; }

  Geometry geometry;
  ShiftedOutline outline{geometry};
  LeafTraces traces;
};

TEST(LeafTrace, ALineThroughIsOnePieceOfTwoCrossings) {
  const Traced above({{-1, 0.25}, {2, 0.25}, {2, 5}, {-1, 5}});
  const LeafTrace trace = above.trace();
  ASSERT_EQ(trace.pieces.size(), 1U);
  const Crossing &entry = trace.crossing(trace.pieces[0].entry), &exit = trace.crossing(trace.pieces[0].exit);
  EXPECT_EQ(entry.side, Side::left);
  EXPECT_EQ(entry.position, (Point{0, 0.25}));
  EXPECT_TRUE(entry.enters);
  EXPECT_EQ(exit.side, Side::right);
  EXPECT_EQ(exit.position, (Point{1, 0.25}));
  EXPECT_FALSE(exit.enters);
  EXPECT_TRUE(trace.vertices_of(trace.pieces[0]).empty());
}

TEST(LeafTrace, ALoopInsideHasNoCrossings) {
  const Traced inside({{0.2, 0.2}, {0.8, 0.2}, {0.5, 0.8}});
  const LeafTrace trace = inside.trace();
  ASSERT_EQ(trace.pieces.size(), 1U);
  EXPECT_TRUE(trace.crossings.empty());
  EXPECT_EQ(trace.pieces[0].entry, -1);
  EXPECT_EQ(trace.pieces[0].exit, -1);
  EXPECT_EQ(trace.vertices_of(trace.pieces[0]).size(), 3U);
}

TEST(LeafTrace, APieceBeginsBeforeTheLoopsFirstVertex) {
  const Traced through({{0.5, 0.5}, {2, 0.5}, {2, 3}, {-1, 3}, {-1, 0.25}});  // vertex 0 lies inside
  const LeafTrace trace = through.trace();
  ASSERT_EQ(trace.pieces.size(), 1U);
  EXPECT_EQ(trace.pieces[0].first_segment, 4);
  ASSERT_EQ(trace.vertices_of(trace.pieces[0]).size(), 1U);
  EXPECT_EQ(trace.vertices_of(trace.pieces[0])[0], 0);
}

TEST(LeafTrace, ASpikeIntoTheLeafAndBackIsAPieceOfOneSide) {
  const Traced spike({{-1, 0.4}, {0.7, 0.5}, {-1, 0.6}, {-2, 0.5}});
  ASSERT_EQ(spike.trace().pieces.size(), 1U);
  for (const Crossing& crossing : spike.trace().crossings) EXPECT_EQ(crossing.side, Side::left);
}

TEST(LeafTrace, OneSegmentMayCutTwoCorners) {
  const Traced slanted({{-0.5, 0.25}, {0.25, -0.5}, {5, -0.5}, {5, 0.9}, {0.8, 5}, {-0.5, 5}});
  const LeafTrace trace = slanted.trace();
  for (const Piece& piece : trace.pieces) {
    EXPECT_NE(trace.crossing(piece.entry).side, trace.crossing(piece.exit).side);
  }
}

TEST(LeafTrace, OutlinesAlongASideBelongToTheDomainsLeaf) {
  EXPECT_EQ(Traced({{-1, 0}, {2, 0}, {2, 5}, {-1, 5}}).trace().pieces.size(), 1U);
  EXPECT_EQ(Traced({{2, 0}, {-1, 0}, {-1, -5}, {2, -5}}).trace().pieces.size(), 0U);
}

TEST(LeafTraces, ClearForgetsAll) {
  Traced traced({{0.2, 0.2}, {0.8, 0.2}, {0.5, 0.8}});
  traced.traces.clear();
  traced.traces.add(traced.outline, {{0, 0}, {1, 1}}, std::vector<std::int32_t>{});
  EXPECT_TRUE(traced.trace().pieces.empty());
  EXPECT_TRUE(traced.trace().vertices.empty());
}

/// A wavy closed curve through many leaves, some of its vertices on grid vertices.
std::vector<Point> wave() {
  std::vector<Point> points;
  for (int i = 0; i < 90; ++i) {
    const double angle = 2 * std::numbers::pi * i / 90, r = 1.2 + 0.5 * std::sin(7 * angle);
    points.push_back(
        {2 + std::round(16 * r * std::cos(angle)) / 16, 2 + std::round(16 * r * std::sin(angle)) / 16});
  }
  return points;
}

TEST(LeafTraces, LeavesShareCrossingsAndPartTheVertices) {
  const Geometry geometry = test::loops_of({wave()});
  const ShiftedOutline outline(geometry);
  LeafTraces traces;
  std::map<Point, int> balance;
  std::map<Point, int> seen;
  std::vector<int> vertices(geometry.size(), 0);
  for (int x = 0; x < 16; ++x) {
    for (int y = 0; y < 16; ++y) {
      const Box box{{x / 4.0, y / 4.0}, {(x + 1) / 4.0, (y + 1) / 4.0}};
      std::vector<std::int32_t> segments;
      for (std::int32_t s = 0; s < geometry.size(); ++s) {
        if (outline.meets(s, box)) segments.push_back(s);
      }
      const LeafTrace trace = traces[traces.add(outline, box, segments)];
      for (const Crossing& crossing : trace.crossings) {
        ++seen[crossing.position];
        balance[crossing.position] += crossing.enters ? 1 : -1;
      }
      for (const Piece& piece : trace.pieces) {
        for (const std::int32_t vertex : trace.vertices_of(piece)) ++vertices[vertex];
      }
    }
  }
  EXPECT_GT(seen.size(), 60U);
  for (const auto& [position, count] : seen) {
    EXPECT_EQ(count % 2, 0) << position.x << " " << position.y;
    EXPECT_EQ(balance[position], 0) << position.x << " " << position.y;
  }
  EXPECT_EQ(vertices, std::vector<int>(geometry.size(), 1));
}

}  // namespace
}  // namespace quadloop
