// Inner lines that end on curves, cross them or are curves: nodes lie on the curves, also in smoothed meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <set>

#include "generate/digests.hpp"
#include "generate/free_baffles.hpp"
#include "generate/generate.hpp"
#include "generate/nearer_chords.hpp"
#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"
#include "tests/build/sound_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

constexpr double whole_turn = 2 * std::numbers::pi;

Chain arc_chain(const std::string& name, const EllipticArc& arc) {
  Chain chain{name, true, {arc.point_at(arc.begin)}, name};
  if (arc.end - arc.begin < whole_turn) {
    append_arc(chain, arc);
    return chain;
  }
  append_arc(chain, arc, chain.points.front());
  chain.points.pop_back();
  chain.open = false;
  return chain;
}

EllipticArc round_arc(Point centre, double radius, double begin = 0, double end = whole_turn) {
  return {centre, {radius, 0}, {0, radius}, begin, end};
}

LineRule path_rule(const std::string& name, std::vector<Point> path, bool spline = false) {
  return {name, {}, std::move(path), false, "case", spline};
}
LineRule chain_rule(const std::string& name) { return {name, name, {}, false, "case"}; }

MeshInput square_round(std::vector<Chain> chains, std::vector<LineRule> lines) {
  chains.insert(chains.begin(), {"box", false, {{-2, -2}, {2, -2}, {2, 2}, {-2, 2}}, "box"});
  AssembleOptions options;
  options.lines = std::move(lines);
  Warnings warnings;
  MeshInput input{assemble(std::move(chains), options, warnings), {}, {}, 0};
  input.mesh.size.min = 0.06;
  input.mesh.size.max = 0.25;
  input.digest = case_digest(input.mesh);
  return input;
}

/// The distance of a point from a boundary of a geometry.
double off(const Geometry& g, const std::string& boundary, Point p) {
  double nearest = 1;
  for (std::int32_t s = 0; s < g.size(); ++s) {
    if (g.boundary(g.boundary_of(s)).name == boundary)
      nearest = std::min(nearest, length(p - above_chord(g.segment(s), p).point));
  }
  return nearest;
}

/// Meshes of both types, unsmoothed and smoothed: valid, the same on one rank, with nodes on the boundaries.
/// Calls `check(whole)` for each on the root.
template <class Check>
void expect_nodes_on_lines(MeshInput input, const Check& check) {
  const Communicator self(MPI_COMM_SELF);
  const Geometry& g = input.geometry;
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    for (const int sweeps : {0, 5}) {
      input.mesh.type = type;
      input.smooth.sweeps = sweeps;
      const Mesh whole = gather_whole(world(), generate_mesh(world(), input).result.mesh);
      const Mesh alone = generate_mesh(self, input).result.mesh;
      if (!world().is_root()) continue;
      test::expect_equal_meshes(whole, alone);
      EXPECT_TRUE(validate(whole).empty());
      for (const BoundaryEdges& boundary : whole.boundaries) {
        EXPECT_FALSE(boundary.edges.empty()) << boundary.name;
        for (const auto& edge : boundary.edges) {
          for (const NodeId node : edge)
            EXPECT_LT(off(g, boundary.name, whole.point(node)), 1e-14) << boundary.name;
        }
      }
      std::set<Point> nodes(whole.points.begin(), whole.points.end());
      for (std::int32_t v = 0; v < g.size(); ++v)
        EXPECT_TRUE(!g.kept(v) || nodes.contains(g.point(v))) << g.point(v).x << " " << g.point(v).y;
      check(whole);
    }
  }
}

std::set<Point> places_of(const Mesh& whole, const std::string& boundary) {
  std::set<Point> places;
  for (const BoundaryEdges& b : whole.boundaries) {
    for (const auto& edge : b.edges) {
      if (b.name == boundary) places.insert({whole.point(edge[0]), whole.point(edge[1])});
    }
  }
  return places;
}

TEST(CurvedLines, StraightLinesEndOnACircleAndCrossIt) {
  const MeshInput input = square_round({arc_chain("body", round_arc({0.1, 0.05}, 0.8))},
                                       {path_rule("on", {{0.1 + 0.8 * std::sqrt(0.75), 0.45}, {1.7, 1.2}}),
                                        path_rule("across", {{-1.9, -1.1}, {1.8, 0.3}})});
  expect_nodes_on_lines(input, [&](const Mesh& whole) {
    for (const std::string line : {"on", "across"}) {
      for (const Point p : places_of(whole, line)) EXPECT_GT(length(p - Point{0.1, 0.05}), 0.8 - 1e-14);
    }
    for (const Point p : places_of(whole, "body")) EXPECT_NEAR(length(p - Point{0.1, 0.05}), 0.8, 1e-14);
  });
}

TEST(CurvedLines, CurvesCrossEachOtherAndThemselves) {
  const std::vector<Chain> chains{arc_chain("body", {{0, 0}, {0.5, 0.1}, {-0.05, 0.3}, 0, whole_turn}),
                                  arc_chain("ring", round_arc({0.2, 0.1}, 0.9)),
                                  arc_chain("arc", round_arc({-0.6, -0.7}, 0.8, 0.3, 2.9))};
  const MeshInput input = square_round(
      chains,
      {chain_rule("ring"), chain_rule("arc"),
       path_rule("eight",
                 {{-1.8, 0.9}, {-0.6, 1.5}, {0.6, 0.9}, {1.7, 1.4}, {1.6, 0.4}, {0.4, 1.1}, {-0.4, 1.7}},
                 true)});
  expect_nodes_on_lines(input, [&](const Mesh& whole) {
    EXPECT_GT(places_of(whole, "eight").size(), 20U);
    for (const Point p : places_of(whole, "ring")) EXPECT_NEAR(length(p - Point{0.2, 0.1}), 0.9, 1e-14);
    for (const Point p : places_of(whole, "arc")) EXPECT_NEAR(length(p - Point{-0.6, -0.7}), 0.8, 1e-14);
  });
}

/// The number of nodes at each place of a boundary.
std::map<Point, int> copies_on(const Mesh& whole, const std::string& boundary) {
  const std::set<Point> places = places_of(whole, boundary);
  std::map<Point, int> copies;
  for (const Point p : whole.points) {
    if (places.contains(p)) ++copies[p];
  }
  return copies;
}

TEST(CurvedLines, BafflesHaveEqualNodesOnBothSidesOfACurve) {
  LineRule vane = path_rule("vane", {{0.8, 0}, {1.1, 0.1}, {1.4, 0.05}, {1.8, 0.3}}, true);
  LineRule shield = chain_rule("shield"), ring = chain_rule("ring");
  vane.baffle = shield.baffle = ring.baffle = true;
  const std::vector<Chain> chains{arc_chain("body", round_arc({0, 0}, 0.8)),
                                  arc_chain("shield", round_arc({0.1, 0.1}, 1.3, 2, 4)),
                                  arc_chain("ring", round_arc({1.3, -1.2}, 0.4))};
  expect_nodes_on_lines(square_round(chains, {vane, shield, ring}), [&](const Mesh& whole) {
    for (const std::string name : {"vane", "shield", "ring"}) {
      const std::map<Point, int> copies = copies_on(whole, name);
      EXPECT_EQ(places_of(whole, name), places_of(whole, name + "__right"));
      const auto single = std::ranges::count_if(copies, [](const auto& c) { return c.second == 1; });
      EXPECT_EQ(single, name == "ring" ? 0 : name == "vane" ? 1 : 2) << name;  // free ends
      EXPECT_GT(copies.size(), 6U);
    }
  });
}

/// Baffles with free ends, two of which the mesh would represent by one edge: "cut" and "along".
TEST(CurvedLines, ShortBafflesHaveANodeOnEachSideBetweenTheirEnds) {
  std::vector<LineRule> rules{
      path_rule("cut", {{-0.8456043135315514, 0.2233964741103911}, {-0.5200819086046253, 0.527802490498356}}),
      path_rule("bent", {{-1.645712753744809, 0.7676541082285802},
                         {-1.5836728, 0.6586846},
                         {-1.5196328629768199, 0.5471150604219108}}),
      path_rule("along", {{0.25, -1}, {0.5, -1}}), chain_rule("arc")};
  for (LineRule& rule : rules) rule.baffle = true;
  const std::vector<Chain> chains{arc_chain("arc", round_arc({1, 0.75}, 0.5, 4.32, 4.82))};
  MeshInput input = square_round(chains, rules);
  std::set<std::string> of_two_edges;
  expect_nodes_on_lines(input, [&](const Mesh& whole) {
    for (const LineRule& rule : rules) {
      const std::map<Point, int> copies = copies_on(whole, rule.name);
      EXPECT_EQ(copies, copies_on(whole, rule.name + "__right"));
      const auto on_both_sides = std::ranges::count_if(copies, [](const auto& c) { return c.second == 2; });
      EXPECT_EQ(on_both_sides, std::ssize(copies) - 2) << rule.name;
      EXPECT_GE(on_both_sides, 1) << rule.name;
      if (on_both_sides == 1) of_two_edges.insert(rule.name);
    }
    EXPECT_EQ(of_two_edges, (std::set<std::string>{"along", "bent", "cut"}));
  });
  MeshResult built = build_mesh(world(), input.geometry, input.mesh);
  for (const std::int64_t added : {4, 0}) {  // both edges are divided the first time, on both sides
    const NodeFlags flags = divide_free_baffles(world(), input.geometry, built);
    std::int64_t own = 0;
    for (const NodeId node : flags.ids()) own += node.value() < built.mesh.owned_nodes ? flags[node] : 0;
    EXPECT_EQ(world().sum(own), added);
  }
}

TEST(CurvedLines, ChordsAreShorterAtInvertedCells) {
  const MeshInput input = square_round({arc_chain("body", round_arc({0.1, 0.05}, 0.8))}, {});
  const Geometry& g = input.geometry;
  Mesh mesh = build_mesh(world(), g, input.mesh).mesh;
  EXPECT_FALSE(nearer_chords(world(), g, mesh));
  for (Point& p : mesh.points) {
    if (length(p - Point{0.9, 0.05}) < 0.2 && length(p - Point{0.1, 0.05}) < 0.81) p = p + Point{0.3, 0};
  }
  const std::optional<Geometry> nearer = nearer_chords(world(), g, mesh);
  ASSERT_TRUE(nearer);
  EXPECT_GT(nearer->size(), g.size());
  EXPECT_LT(nearer->size(), 2 * g.size());  // far curves stay
  for (std::int32_t v = 4; v < nearer->size(); ++v)
    EXPECT_NEAR(length(nearer->point(v) - Point{0.1, 0.05}), 0.8, 1e-14);
}

/// Straight lines, splines, circles, arcs and ellipses at random places round a circle, some of them baffles.
MeshInput random_arrangement(std::mt19937& random) {
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto place = [&] { return Point{number(-2.1, 2.1), number(-2.1, 2.1)}; };
  std::vector<Chain> chains;
  if (random() % 2 == 0) chains.push_back(arc_chain("body", round_arc({number(-1, 1), number(-1, 1)}, 0.6)));
  std::vector<LineRule> rules;
  const std::size_t count = 1 + random() % 4;
  for (std::size_t i = 0; i < count; ++i) {
    const std::string name = "line" + std::to_string(i);
    if (random() % 2 == 0) {
      std::vector<Point> path(2 + random() % 4);
      for (Point& p : path) p = place();
      rules.push_back(path_rule(name, path, random() % 3 != 0));
    } else {
      EllipticArc arc = round_arc(place(), number(0.3, 1.2));
      if (random() % 2 == 0) arc.end = arc.begin + number(1, 5);
      if (random() % 3 == 0) arc.minor = number(0.2, 0.8) * arc.minor + number(-0.2, 0.2) * arc.major;
      chains.push_back(arc_chain(name, arc));
      rules.push_back(chain_rule(name));
    }
    rules.back().baffle = random() % 4 == 0;
  }
  return square_round(std::move(chains), std::move(rules));
}

TEST(CurvedLines, RandomArrangementsAreValidOrRefusedWithAPlace) {
  std::mt19937 random(43);
  constexpr int trials = 6;
  int made = 0;
  for (int trial = 0; trial < trials; ++trial) {
    SCOPED_TRACE(trial);
    try {
      MeshInput input = random_arrangement(random);
      input.mesh.type = trial % 2 == 0 ? MeshType::hybrid : MeshType::delaunay;
      input.mesh.size.min = 0.008;
      input.smooth.sweeps = 3;
      const GeneratedMesh generated = generate_mesh(world(), input);
      const Mesh whole = gather_whole(world(), generated.result.mesh);
      ++made;
      if (!world().is_root()) continue;
      EXPECT_TRUE(validate(whole).empty());
      const bool all_points_are_nodes = generated.result.report.corners_lost == 0;
      for (const BoundaryEdges& boundary : whole.boundaries) {
        for (const auto& edge : boundary.edges)
          EXPECT_LT(off(input.geometry, boundary.name, whole.point(edge[0])),
                    all_points_are_nodes ? 1e-14 : input.mesh.size.min)
              << boundary.name << " " << whole.point(edge[0]).x << " " << whole.point(edge[0]).y;
      }
    } catch (const InputError& error) {
      for (const char* const part : {"(", ";"})
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(made, trials);
}

}  // namespace
}  // namespace quadloop
