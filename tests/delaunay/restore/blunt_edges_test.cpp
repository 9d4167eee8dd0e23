#include "mesher/delaunay/restore/blunt_edges.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace quadloop {
namespace {

using Nodes = std::vector<std::int32_t>;

/// A flat kite: 0 and 1 are the ends of its long diagonal, 2 and 3 lie beside it; 4 closes it on the right.
///
///            2
///      0 ---------- 1      4
///            3
Mesh kite() {
  Mesh mesh;
  mesh.points = {{0, 0}, {10, 0}, {5, 1}, {5, -1}, {11, 5}};
  mesh.owned_nodes = size32(mesh.points);
  const auto add = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    mesh.triangles.push_back({NodeId{a}, NodeId{b}, NodeId{c}});
  };
  add(0, 1, 2);
  add(1, 0, 3);
  add(2, 1, 4);
  return mesh;
}

NodeFlags flags(const Mesh& mesh, const Nodes& flagged) {
  NodeFlags near(mesh.points.size(), 0);
  for (const std::int32_t node : flagged) near[NodeId{node}] = 1;
  return near;
}

struct Found {
  std::set<Nodes> pairs, singles;
};

Found look(const Mesh& mesh, const NodeFlags& near, const Nodes& moved = {0, 1, 2, 3, 4}) {
  BluntEdges edges(mesh, flags(mesh, moved), near);
  Found found;
  edges.for_each_pair([&](NodeId a, NodeId b, NodeId c, NodeId d) {
    found.pairs.insert({a.value(), b.value(), c.value(), d.value()});
  });
  edges.for_each_single([&](NodeId a, NodeId b, NodeId c) {
    found.singles.insert({a.value(), b.value(), c.value()});
  });
  return found;
}

TEST(BluntEdges, PairsHaveTheTriangleAcrossAsItTurns) {
  const Mesh mesh = kite();
  const Found found = look(mesh, flags(mesh, {0, 1, 2, 3, 4}));
  EXPECT_EQ(found.pairs, (std::set<Nodes>{{0, 1, 2, 3}, {1, 0, 3, 2}}));  // blunt from both sides
  EXPECT_EQ(found.singles, (std::set<Nodes>{{4, 2, 1}}));                 // the way from 4 to 2 has no other
}

TEST(BluntEdges, OneWhoseTriangleAcrossIsAnotherRanksIsSingle) {
  Mesh mesh = kite();
  mesh.triangles.erase(mesh.triangles.begin() + 1);
  const Found found = look(mesh, flags(mesh, {0, 1, 2, 4}));
  EXPECT_TRUE(found.pairs.empty());
  EXPECT_EQ(found.singles, (std::set<Nodes>{{0, 1, 2}, {4, 2, 1}}));
}

TEST(BluntEdges, OnlyBetweenNodesNear) {
  const Mesh mesh = kite();
  const Found found = look(mesh, flags(mesh, {0, 2, 3, 4}));
  EXPECT_TRUE(found.pairs.empty());
  EXPECT_EQ(found.singles, (std::set<Nodes>{{4, 2, 1}}));
}

/// Three corners of a square, whose diagonal 0-1 has node 3 beyond it.
Mesh half_square(Point p3) {
  Mesh mesh;
  mesh.points = {{1, 0}, {0, 1}, {0, 0}, p3, {5, 5}};
  mesh.owned_nodes = size32(mesh.points);
  mesh.triangles = {{NodeId{0}, NodeId{1}, NodeId{2}}, {NodeId{1}, NodeId{0}, NodeId{3}}};
  return mesh;
}

TEST(BluntEdges, ARightAngleThatStayedIsLeftToTheTriangleAcross) {
  for (const Point& p3 : {Point{1.1, 1.1}, Point{0.9, 0.9}}) {
    const Mesh mesh = half_square(p3);
    const NodeFlags near = flags(mesh, {0, 1, 2, 3});
    EXPECT_EQ(look(mesh, near, {3}).pairs.size(), p3.x < 1 ? 1U : 0U);  // inside the circle, by its own angle
    EXPECT_EQ(look(mesh, near, {2, 3}).pairs.size(), p3.x < 1 ? 2U : 1U);
  }
}

}  // namespace
}  // namespace quadloop
