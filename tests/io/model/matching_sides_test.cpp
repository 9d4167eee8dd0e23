#include "io/model/matching_sides.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tests/mesh/grid_mesh.hpp"

namespace quadloop::io {
namespace {

/// A grid with a boundary for each side, in any order of edges, its nodes elsewhere.
Mesh four_sides(const std::function<Point(Point)>& place) {
  Mesh mesh = test::Grid{6}.mesh();
  std::vector<std::array<NodeId, 2>> edges;
  for (const BoundaryEdges& boundary : mesh.boundaries)
    edges.insert(edges.end(), boundary.edges.begin(), boundary.edges.end());
  std::ranges::reverse(edges);
  mesh.boundaries = {
      {"south", "none", {}}, {"east", "none", {}}, {"north", "none", {}}, {"west", "none", {}}};
  for (const auto& edge : edges) {
    const Point middle = 0.5 * (mesh.point(edge[0]) + mesh.point(edge[1]));
    const std::size_t side = middle.y == 0 ? 0 : middle.x == 1 ? 1 : middle.y == 1 ? 2 : 3;
    mesh.boundaries[side].edges.push_back(edge);
  }
  for (Point& p : mesh.points) p = place(p);
  return mesh;
}

std::vector<std::string> matching_names(const Mesh& mesh) {
  const std::vector<NodeId> nodes = nodes_of_matching_sides(mesh);
  std::vector<std::string> names;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    if (std::ranges::all_of(boundary.edges, [&](const auto& edge) {
          return std::ranges::binary_search(nodes, edge[0]) && std::ranges::binary_search(nodes, edge[1]);
        }))
      names.push_back(boundary.name);
  }
  return names;
}

double uneven(double x) { return x + 0.1 * std::sin(3 * x); }

TEST(MatchingSides, AreImagesUnderATranslation) {
  const auto bent = [](Point p) {
    return Point{uneven(p.x), p.y * (1 + 0.4 * p.x * p.y * (1 - p.y)) + 0.2 * std::sin(7 * p.x)};
  };
  EXPECT_EQ(matching_names(four_sides(bent)), (std::vector<std::string>{"south", "north"}));
}

TEST(MatchingSides, AreImagesUnderARotation) {
  const auto sector = [](Point p) {
    const double radius = 1 + uneven(p.x), angle = 0.7 * p.y * p.y + 0.3 * p.x;
    return Point{radius * std::cos(angle), radius * std::sin(angle)};
  };
  EXPECT_EQ(matching_names(four_sides(sector)), (std::vector<std::string>{"south", "north"}));
}

TEST(MatchingSides, OneNodeElsewhereIsNoMatch) {
  Mesh mesh = four_sides([](Point p) { return Point{uneven(p.x), p.y * p.y}; });
  EXPECT_EQ(matching_names(mesh), (std::vector<std::string>{"south", "east", "north", "west"}));
  mesh.points[mesh.boundaries[0].edges[2][0].value()].x += 1e-6;
  mesh.points[mesh.boundaries[1].edges[2][0].value()].y += 1e-6;
  EXPECT_TRUE(matching_names(mesh).empty());
}

TEST(MatchingSides, ClosedBoundariesHaveNone) {
  Mesh mesh = four_sides([](Point p) { return p; });
  for (std::size_t k = 1; k < 4; ++k)
    mesh.boundaries[0].edges.insert(mesh.boundaries[0].edges.end(), mesh.boundaries[k].edges.begin(),
                                    mesh.boundaries[k].edges.end());
  mesh.boundaries.resize(1);
  EXPECT_TRUE(nodes_of_matching_sides(mesh).empty());
}

}  // namespace
}  // namespace quadloop::io
