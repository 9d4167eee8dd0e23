// Meshes with inner lines: valid, with an edge on each part of a line, the same on any number of ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <string>

#include "mesher/base/error.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/build/near_ends.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/build/sound_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

using Path = std::vector<Point>;

AssembleOptions with_lines(const std::vector<Path>& paths) {
  AssembleOptions options;
  for (std::size_t i = 0; i < paths.size(); ++i)
    options.lines.push_back({"line" + std::to_string(i), {}, paths[i], false, "case"});
  return options;
}

Geometry square_with(AssembleOptions options, std::vector<Chain> more = {}) {
  std::vector<Chain> chains{{"wall", false, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, {}}};
  chains.insert(chains.end(), more.begin(), more.end());
  Warnings warnings;
  return assemble(chains, options, warnings);
}

MeshOptions sizes(double min, double max) {
  MeshOptions options;
  options.size.min = min;
  options.size.max = max;
  return options;
}

/// The length of the inner lines of a geometry or a mesh.
double length_of_lines(const Geometry& g) {
  double sum = 0;
  for (std::int32_t s = 0; s < g.size(); ++s) {
    if (g.is_inner_line(s) && (!g.is_second(s) || g.boundary(g.boundary_of(s)).baffle))
      sum += length(g.point(g.next(s)) - g.point(s));
  }
  return sum;
}
double length_of_lines(const Mesh& whole) {
  double sum = 0;
  for (const BoundaryEdges& boundary : whole.boundaries) {
    for (const auto& [from, to] : boundary.edges)
      sum += boundary.name.starts_with("line") ? length(whole.point(to) - whole.point(from)) : 0;
  }
  return sum;
}

/// Each node of a line lies on it, and its edges are sides of two cells.
void expect_edges_on_lines(const Geometry& g, const Mesh& whole, double distance) {
  std::set<std::array<NodeId, 2>> sides;
  const auto add = [&](const auto& cells) {
    for (const auto& nodes : cells) {
      for (std::size_t k = 0; k < nodes.size(); ++k) sides.insert({nodes[k], nodes[(k + 1) % nodes.size()]});
    }
  };
  add(whole.triangles);
  add(whole.quads);
  for (const BoundaryEdges& boundary : whole.boundaries) {
    if (!boundary.inner_line) continue;
    for (const auto& [from, to] : boundary.edges) {
      EXPECT_TRUE(sides.contains({from, to}) && sides.contains({to, from})) << whole.point(from).x;
      for (const NodeId node : {from, to}) {
        double nearest = 1;
        for (std::int32_t s = 0; s < g.size(); ++s) {
          if (g.boundary(g.boundary_of(s)).name == boundary.name)
            nearest =
                std::min(nearest, distance_to_segment(whole.point(node), g.point(s), g.point(g.next(s))));
        }
        EXPECT_LT(nearest, distance);
      }
    }
  }
}

/// Points that must be nodes; `lost`: so many may be missing, where several lie in one smallest cell.
void expect_nodes_at_kept(const Geometry& g, const Mesh& whole, std::int64_t lost) {
  const std::set<Point> nodes(whole.points.begin(), whole.points.end());
  std::set<Point> missing;
  for (std::int32_t v = 0; v < g.size(); ++v) {
    if (g.kept(v) && !nodes.contains(g.point(v))) missing.insert(g.point(v));
  }
  EXPECT_EQ(std::ssize(missing), lost);
}

/// Each type of mesh is valid, follows the lines, and is the same on one rank. `shorter`: how much of the
/// lines chords may cut off; `distance`: of nodes from their line, where lines meet within a smallest cell.
void expect_meshes(const Geometry& geometry, const MeshOptions& given, double shorter = 1e-12,
                   double distance = 1e-12) {
  test::expect_sound_meshes(geometry, given, [&](const Mesh& whole, const MeshResult& made) {
    expect_edges_on_lines(geometry, whole, distance);
    expect_nodes_at_kept(geometry, whole, made.report.corners_lost);
    const double wanted = length_of_lines(geometry);
    EXPECT_NEAR(length_of_lines(whole), wanted, shorter * wanted);
  });
}

TEST(Lines, FromWallToWall) {
  expect_meshes(square_with(with_lines({{{0, 0.31}, {0.47, 0.53}, {1, 0.61}}})), sizes(0.02, 0.1), 0.002);
}

TEST(Lines, AnOpenLineEndsInsideCells) {
  expect_meshes(square_with(with_lines({{{0.31, 0.41}, {0.53, 0.53}, {0.72, 0.61}}})), sizes(0.02, 0.1),
                0.002);
  expect_meshes(square_with(with_lines({{{0.501, 0.502}, {0.513, 0.509}}})), sizes(0.002, 0.1));
}

TEST(Lines, OnGridLinesAndGridVertices) {
  MeshOptions options = sizes(0.03125, 0.125);
  options.size.root = RootOptions{{0, 0}, 1, 1, 1};
  for (const Path& path : {Path{{0.25, 0.5}, {0.6875, 0.5}}, Path{{0.7, 0.5}, {0.3, 0.5}},
                           Path{{0.5, 0}, {0.5, 0.75}}, Path{{0.5, 0.72}, {0.5, 0.31}},
                           Path{{0.125, 0.125}, {0.375, 0.375}}, Path{{0.375, 0.125}, {0.125, 0.375}},
                           Path{{0.5, 0.5}, {0.9, 0.77}}, Path{{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}}})
    expect_meshes(square_with(with_lines({path})), options);
}

TEST(Lines, ClosedOnesAndCrossings) {
  expect_meshes(square_with(with_lines({{{0.3, 0.3}, {0.7, 0.33}, {0.55, 0.74}, {0.3, 0.3}}})),
                sizes(0.02, 0.1));
  expect_meshes(square_with(with_lines({{{0.1, 0.2}, {0.8, 0.7}, {0.9, 0.3}, {0.3, 0.62}},
                                        {{0, 0.5}, {0.5, 0.45}, {0.7, 0.1}},
                                        {{0.2, 0.9}, {0.55, 0.3}, {0.6, 1}}})),
                sizes(0.005, 0.08));
}

TEST(Lines, BesideAnIslandAndAcrossBlocks) {
  const Chain island{"island", false, {{0.4, 0.4}, {0.4, 0.6}, {0.6, 0.6}, {0.6, 0.4}}, {}};
  expect_meshes(square_with(with_lines({{{0.2, 0.5}, {0.4, 0.5}}, {{0.6, 0.55}, {1, 0.9}}}), {island}),
                sizes(0.01, 0.1));
  AssembleOptions options = with_lines({{{0.2, 0.5}, {0.8, 0.55}}});
  options.blocks = {{"outer", {}, "wall", {}, "case"}, {"inner", {}, "island", {}, "case"}};
  expect_meshes(square_with(options, {island}), sizes(0.01, 0.1));
}

double length_of(const Mesh& whole, const std::string& name) {
  double sum = 0;
  for (const BoundaryEdges& boundary : whole.boundaries) {
    for (const auto& [from, to] : boundary.edges)
      sum += boundary.name == name ? length(whole.point(to) - whole.point(from)) : 0;
  }
  return sum;
}

/// Nodes that coincide with an earlier one.
std::int64_t doubled_nodes(const Mesh& whole) {
  const std::set<Point> places(whole.points.begin(), whole.points.end());
  return std::ssize(whole.points) - std::ssize(places);
}

/// A line of n edges has n - 1 doubled nodes, and one more for each end on a wall.
void expect_two_sides(const std::vector<Path>& paths, std::int64_t doubled_beyond_edges) {
  AssembleOptions options = with_lines(paths);
  for (LineRule& rule : options.lines) rule.baffle = true;
  const Geometry geometry = square_with(options);
  expect_meshes(geometry, sizes(0.01, 0.1));
  for (const MeshType type : {MeshType::hybrid, MeshType::delaunay}) {
    MeshOptions wanted = sizes(0.01, 0.1);
    wanted.type = type;
    const Mesh whole = gather_whole(world(), build_mesh(world(), geometry, wanted).mesh);
    if (!world().is_root()) continue;
    std::int64_t edges = 0;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const std::string left = "line" + std::to_string(i);
      EXPECT_GT(length_of(whole, left), 0.1);
      EXPECT_NEAR(length_of(whole, left), length_of(whole, left + "__right"), 1e-12);
      for (const BoundaryEdges& boundary : whole.boundaries) {
        EXPECT_FALSE(boundary.inner_line);
        edges += boundary.name == left ? std::ssize(boundary.edges) : 0;
      }
    }
    EXPECT_EQ(doubled_nodes(whole), edges + doubled_beyond_edges);
  }
}

TEST(Lines, BafflesHaveNodesOnBothSides) {
  expect_two_sides({{{0.31, 0.41}, {0.72, 0.61}}}, -1);
  expect_two_sides({{{0.5, 0.25}, {0.5, 0.75}}}, -1);
  // Passes grid vertices at the distance of rounding.
  expect_two_sides({{{0.25, 0}, {0.35, 0.55}}}, 0);
  expect_two_sides({{{0, 0.4}, {0.5, 0.6}}}, 0);
  expect_two_sides({{{0, 0.4}, {1, 0.6}}}, 1);
  expect_two_sides({{{0.3, 0.3}, {0.7, 0.33}, {0.55, 0.74}, {0.3, 0.3}}}, 0);
  // Three copies beside the one where they cross, none at the four ends.
  expect_two_sides({{{0.2, 0.25}, {0.8, 0.7}}, {{0.2, 0.8}, {0.75, 0.2}}}, -4 + 3);
}

std::vector<std::string> warnings_with(const std::vector<Path>& paths, double join) {
  AssembleOptions options = with_lines(paths);
  options.join = join;
  return build_mesh(world(), square_with(options), sizes(0.01, 0.1)).report.warnings;
}

TEST(Lines, EndsNextToABoundaryAreNamedWithARemedy) {
  const double usual = AssembleOptions{}.join;
  const std::vector<Path> off_the_wall{{{0.41, 0.0012}, {0.43, 0.37}}};
  const std::vector<std::string> said = warnings_with(off_the_wall, usual);
  ASSERT_EQ(said.size(), 1U);
  for (const char* const part :
       {"'line0'", "(0.41, 0.0012)", "0.0012 away from boundary 'wall'", "set join = 0.0013 in [geometry]"})
    EXPECT_NE(said[0].find(part), std::string::npos) << said[0];
  EXPECT_TRUE(warnings_with(off_the_wall, 0.0013).empty());
  EXPECT_TRUE(warnings_with({{{0.41, 0}, {0.43, 0.37}}}, usual).empty());
  EXPECT_TRUE(warnings_with({{{0.41, 0.03}, {0.43, 0.37}}}, usual).empty());
  // Next to another line, and both ends of a line that nearly closes; not one with points close to its end.
  const std::vector<std::string> several =
      warnings_with({{{0.2, 0.5}, {0.8, 0.5}},
                     {{0.5, 0.501}, {0.5, 0.9}},
                     {{0.6, 0.2}, {0.8, 0.2}, {0.7, 0.4}, {0.602, 0.2005}}},
                    usual);
  ASSERT_EQ(several.size(), 1U);
  EXPECT_NE(several[0].find("'line2'"), std::string::npos) << several[0];
  EXPECT_NE(several[0].find("(3 such ends)"), std::string::npos) << several[0];
  const Geometry bare = square_with({});
  EXPECT_FALSE(warning_of_near_ends(world(), bare, build_mesh(world(), bare, sizes(0.01, 0.1)).mesh));
  EXPECT_TRUE(warnings_with({{{0.3, 0.31}, {0.301, 0.311}, {0.302, 0.311}, {0.6, 0.6}}}, usual).empty());
}

TEST(Lines, OutsideTheDomainAreRefused) {
  try {
    square_with(with_lines({{{2, 2}, {3, 3}}}));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'line0' near (2, 2) lies outside"), std::string::npos)
        << error.what();
  }
}

TEST(Lines, RandomArrangementsAreValidOrRefusedWithAPlace) {
  std::mt19937 random(44);
  const auto number = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto eighth = [&](double x) { return random() % 2 == 0 ? std::round(8 * x) / 8 : x; };
  int made = 0, refused = 0;
  for (int trial = 0; trial < 100; ++trial) {
    SCOPED_TRACE(trial);
    std::vector<Path> paths(1 + random() % 4);
    for (Path& path : paths) {
      const std::size_t points = 2 + random() % 4;
      while (path.size() < points) path.push_back({eighth(number(-0.1, 1.1)), eighth(number(-0.1, 1.1))});
      if (points > 3 && random() % 3 == 0) path.push_back(path.front());
    }
    AssembleOptions options = with_lines(paths);
    for (LineRule& rule : options.lines) rule.baffle = random() % 4 == 0;
    std::vector<Chain> more;
    if (random() % 2 == 0) {
      const double x = eighth(number(0.2, 0.5)), y = eighth(number(0.2, 0.5)), size = number(0.1, 0.4);
      more.push_back({"ring", false, {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}}, {}});
      if (random() % 2 == 0)
        options.blocks = {{"outer", {}, "wall", {}, "case"}, {"inner", {}, "ring", {}, "case"}};
    }
    try {
      expect_meshes(square_with(options, more), sizes(0.005, 0.12), 0.02, 0.005);
      ++made;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("("), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find(";"), std::string::npos) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(made, 90) << refused;
}

}  // namespace
}  // namespace quadloop
