// After nodes have moved the mesh is made Delaunay again, with the same triangles in the same order on any
// number of ranks.
#include "mesher/delaunay/restore/restore_delaunay.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "mesher/base/ids.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/node_table.hpp"
#include "mesher/mesh/topology.hpp"
#include "tests/delaunay/rank_of.hpp"
#include "tests/mesh/same_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::expect_same_meshes;
using test::rank_of;
using test::world;

Chain circle(const std::string& name, Point centre, double radius, int vertices) {
  Chain chain;
  chain.name = name;
  for (int i = 0; i < vertices; ++i) {
    const double t = -2 * std::numbers::pi * i / vertices;
    chain.points.push_back({centre.x + radius * std::cos(t), centre.y + radius * std::sin(t)});
  }
  return chain;
}

/// A box around two holes, one of them a pentagon.
MeshResult two_holes(const Communicator& comm, MeshType type, double spacing) {
  Chain box;
  box.name = "box";
  box.points = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  AssembleOptions how;
  BoundaryRule at_holes, at_box;
  at_holes.pattern = "hole*";
  at_holes.spacing = spacing;
  at_box.pattern = "box";
  at_box.spacing = 0.25;
  how.rules = {at_holes, at_box};
  Warnings warnings;
  const Geometry geometry = assemble(
      {box, circle("hole_1", {-0.29, 0.113}, 0.3, 60), circle("hole_2", {0.5, 0.3}, 0.25, 5)}, how, warnings);
  MeshOptions options;
  options.type = type;
  options.size.min = spacing / 4;
  options.size.max = 0.25;
  options.size.root = RootOptions{{-1, -1}, 2, 1, 1};
  return build_mesh(comm, geometry, options);
}

/// As it is before any move: constrained Delaunay under rank_of().
Mesh delaunay_mesh(const Communicator& comm, double spacing = 0.05) {
  Mesh mesh = two_holes(comm, MeshType::delaunay, spacing).mesh;
  restore_delaunay(comm, mesh, NodeFlags(mesh.points.size(), 1), rank_of);
  return mesh;
}

/// Where each node goes, on a whole mesh: those of every so many interior nodes by up to half of their star,
/// as long as no triangle is inverted.
class Moves {
 public:
  Moves(const Mesh& whole, std::int64_t every, unsigned seed)
      : points_{whole.points}, flags_(points_.size(), 0), around_(points_.size()) {
    NodeFlags outer(points_.size(), 0);
    for (const BoundaryEdges& b : whole.boundaries) {
      for (const auto& edge : b.edges) outer[edge[0]] = outer[edge[1]] = 1;
    }
    for (const auto& t : whole.triangles) {
      for (const NodeId node : t) around_[node].push_back(t);
    }
    std::mt19937_64 random(seed);
    for (int sweep = 0; sweep < 3; ++sweep) {
      for (const NodeId node : points_.ids()) {
        const double x = step(random), y = step(random);
        if (outer[node] == 0 && node.value() % every == 0) move(node, {x, y});
      }
    }
  }

  /// To one rank's part; returns the flags of what has moved.
  NodeFlags apply(Mesh& part) const {
    NodeFlags flags(part.points.size(), 0);
    for (const NodeId node : flags.ids()) {
      const NodeId of_whole{static_cast<std::int32_t>(part.global(node).value())};
      part.points[node.value()] = points_[of_whole];
      flags[node] = flags_[of_whole];
    }
    return flags;
  }

 private:
  static double step(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-52 - 1; }

  void move(NodeId node, Point by) {
    const Point before = points_[node];
    double size = 0;
    for (const auto& t : around_[node])
      size = std::max(size, length(points_[t[0]] - before) + length(points_[t[1]] - before));
    points_[node] = before + 0.4 * size * by;
    const bool sound = std::all_of(around_[node].begin(), around_[node].end(), [&](const auto& t) {
      const Point a = points_[t[0]], b = points_[t[1]], c = points_[t[2]];
      const double edge = std::max({length(b - a), length(c - b), length(a - c)});
      return cross(b - a, c - a) > 0.02 * edge * edge;
    });
    if (sound) {
      flags_[node] = 1;
    } else {
      points_[node] = before;
    }
  }

  IdVector<NodeId, Point> points_;
  NodeFlags flags_;
  IdVector<NodeId, std::vector<std::array<NodeId, 3>>> around_;
};

/// Nodes, triangles and boundary edges of all ranks, in the global order, on every rank.
Mesh gather(const Communicator& comm, const Mesh& part) {
  Mesh whole;
  whole.points = comm.all_gather_values(std::span(part.points).first(part.owned_nodes));
  whole.owned_nodes = size32(whole.points);
  const auto renumber = [&](auto rows) {
    for (auto& row : rows) {
      for (NodeId& node : row) node = NodeId{static_cast<std::int32_t>(part.global(node).value())};
    }
    return comm.all_gather_values(std::span<const typename decltype(rows)::value_type>(rows));
  };
  whole.triangles = renumber(part.triangles);
  for (const BoundaryEdges& b : part.boundaries)
    whole.boundaries.push_back({b.name, b.condition, renumber(b.edges)});
  return whole;
}

/// The triangles of a whole mesh, whatever their order.
std::vector<std::array<NodeId, 3>> sorted_triangles(const Mesh& whole) {
  auto triangles = whole.triangles;
  for (auto& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

bool keeps_delaunay(Point a, Point b, Point c, Point d) {
  const int inside = in_circle(a, b, c, d);
  return inside < 0 || (inside == 0 && std::max(rank_of(a), rank_of(b)) > std::max(rank_of(c), rank_of(d)));
}

void expect_delaunay(const Mesh& whole) {
  for (const MeshFault& fault : validate(whole)) ADD_FAILURE() << name_of(fault.rule) << ": " << fault.what;
  const EdgeTable table(whole);
  for_each_cell_edge(whole, [&](NodeId from, NodeId to, std::int32_t cell) {
    const std::int32_t other = table.cell_left_of(to, from);
    if (other < 0) return;
    const auto apex = [&](std::int32_t t) {
      const auto& nodes = whole.triangles[t];
      return whole.point(
          *std::find_if(nodes.begin(), nodes.end(), [&](NodeId n) { return n != from && n != to; }));
    };
    EXPECT_TRUE(keeps_delaunay(whole.point(from), whole.point(to), apex(cell), apex(other)))
        << from.value() << " - " << to.value();
  });
}

void expect_consistent_ghosts(const Mesh& part, const Mesh& whole) {
  for (std::size_t i = 0; i < part.points.size(); ++i) {
    EXPECT_EQ(part.points[i], whole.point(NodeId{static_cast<std::int32_t>(
                                  part.global(NodeId{static_cast<std::int32_t>(i)}).value())}));
  }
}

/// Moves nodes of the whole mesh and of this rank's part, restores both, compares; returns the whole mesh.
Mesh move_and_restore(Mesh whole, Mesh part, std::int64_t every, unsigned seed) {
  const Communicator self(MPI_COMM_SELF);
  const Moves moves(whole, every, seed);
  const auto triangles_before = whole.triangles;
  const NodeFlags moved = moves.apply(part);
  restore_delaunay(self, whole, moves.apply(whole), rank_of);
  restore_delaunay(world(), part, moved, rank_of);
  EXPECT_FALSE(whole.triangles == triangles_before);
  expect_same_meshes(gather(world(), part), whole);
  expect_consistent_ghosts(part, whole);
  expect_delaunay(whole);
  return whole;
}

TEST(RestoreDelaunay, SameOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  const Mesh whole = delaunay_mesh(self), part = delaunay_mesh(world());
  ASSERT_GT(whole.triangles.size(), 1000U);
  expect_same_meshes(gather(world(), part), whole);
  for (const std::int64_t every : {1, 3, 30, 200}) {
    for (unsigned seed = 0; seed < 4; ++seed) move_and_restore(whole, part, every, seed);
  }
}

std::vector<std::array<NodeId, 3>> sorted(std::vector<std::array<NodeId, 3>> triangles) {
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

Point centroid(const Mesh& mesh, const std::array<NodeId, 3>& t) {
  return 1.0 / 3 * (mesh.point(t[0]) + mesh.point(t[1]) + mesh.point(t[2]));
}

/// Which of its nodes is farthest from its centroid, and how far.
double reach(const Mesh& mesh, const std::array<NodeId, 3>& t) {
  double farthest = 0;
  for (const NodeId node : t) farthest = std::max(farthest, length(mesh.point(node) - centroid(mesh, t)));
  return farthest;
}

/// Triangles that share a node are no farther apart than both reach.
void expect_near(const Mesh& before, const Mesh& mesh, const std::vector<std::int32_t>& standing) {
  std::size_t next = 0;
  for (std::size_t place = 0; place < standing.size(); ++place) {
    for (std::int32_t k = 0; k < standing[place]; ++k) {
      const auto& then = before.triangles[place];
      const auto& now = mesh.triangles.at(next++);
      EXPECT_LE(length(centroid(mesh, then) - centroid(mesh, now)),
                1.0001 * (reach(mesh, then) + reach(mesh, now)));
    }
  }
  EXPECT_EQ(next, mesh.triangles.size());
}

TEST(RestoreDelaunayNearby, PutsTrianglesWhereOldOnesWere) {
  const Communicator self(MPI_COMM_SELF);
  const Mesh start = delaunay_mesh(self), start_part = delaunay_mesh(world());
  for (const std::int64_t every : {1, 30, 200}) {
    Mesh whole = start, part = start_part, elsewhere = start;
    const Moves moves(start, every, 5);
    const NodeFlags moved = moves.apply(part);
    const auto standing = restore_delaunay_nearby(self, whole, moves.apply(whole), rank_of);
    const auto of_part = restore_delaunay_nearby(world(), part, moved, rank_of);
    expect_same_meshes(gather(world(), part), whole);
    EXPECT_EQ(world().all_gather_values(std::span<const std::int32_t>(of_part)), standing);
    EXPECT_NE(std::count(standing.begin(), standing.end(), 0), 0);
    expect_near(start, whole, standing);
    restore_delaunay(self, elsewhere, moves.apply(elsewhere), rank_of);
    EXPECT_TRUE(sorted(whole.triangles) == sorted(elsewhere.triangles));
  }
}

/// Leaves know their triangles by the slots.
TEST(RestoreDelaunay, PutsTrianglesInSlotsOfTheSameCavity) {
  const Communicator self(MPI_COMM_SELF);
  const Mesh start = delaunay_mesh(self);
  for (const std::int64_t every : {3, 30, 200}) {
    Mesh moved = start;
    const NodeFlags flags = Moves(start, every, 5).apply(moved);
    Mesh whole = moved;
    restore_delaunay(self, whole, flags, rank_of);
    for (std::size_t slot = 0; slot < whole.triangles.size(); ++slot) {
      const auto &then = moved.triangles[slot], &now = whole.triangles[slot];
      EXPECT_LE(length(centroid(moved, then) - centroid(moved, now)),
                2 * (reach(moved, then) + reach(moved, now)))
          << "slot " << slot << ", every " << every;
    }
  }
}

TEST(RestoreDelaunay, LooksNoFartherThanItMust) {
  const Communicator self(MPI_COMM_SELF);
  const Mesh start = delaunay_mesh(self);
  for (unsigned seed = 0; seed < 12; ++seed) {
    Mesh mesh = start, thorough = start;
    const Moves moves(start, 1 + 7 * seed, seed);
    restore_delaunay(self, mesh, moves.apply(mesh), rank_of);
    moves.apply(thorough);
    restore_delaunay(self, thorough, NodeFlags(thorough.points.size(), 1), rank_of);
    EXPECT_TRUE(mesh.triangles == thorough.triangles);
  }
}

TEST(RestoreDelaunay, NothingMovedNothingChanges) {
  Mesh mesh = delaunay_mesh(world());
  const Mesh before = mesh;
  for (const char flag : {'\0', '\1'}) {
    restore_delaunay(world(), mesh, NodeFlags(mesh.points.size(), flag), rank_of);
    EXPECT_TRUE(mesh.triangles == before.triangles);
    EXPECT_TRUE(mesh.points == before.points);
    EXPECT_TRUE(mesh.ghosts == before.ghosts);
  }
}

/// With quads cut along one diagonal or the other.
Mesh split(Mesh mesh, std::size_t corner) {
  for (const auto& q : mesh.quads) {
    const auto at = [&](std::size_t k) { return q[(corner + k) % 4]; };
    mesh.triangles.push_back({at(0), at(1), at(2)});
    mesh.triangles.push_back({at(0), at(2), at(3)});
  }
  mesh.quads.clear();
  return mesh;
}

TEST(RestoreDelaunay, ForgetsTheDiagonalsThatItBeganWith) {
  const Communicator self(MPI_COMM_SELF);
  const Mesh hybrid = two_holes(world(), MeshType::hybrid, 0.05).mesh;
  std::vector<Mesh> results;
  for (const std::size_t corner : {0U, 1U}) {
    Mesh mesh = split(hybrid, corner);
    restore_delaunay(world(), mesh, NodeFlags(mesh.points.size(), 1), rank_of);
    results.push_back(gather(world(), mesh));
    expect_delaunay(results.back());
  }
  EXPECT_TRUE(sorted_triangles(results[0]) == sorted_triangles(results[1]));
  EXPECT_TRUE(sorted_triangles(results[0]) == sorted_triangles(delaunay_mesh(self)));
}

/// This rank's share of a whole mesh whose nodes and triangles have been shuffled, the first rank left
/// without any of them where there are others.
Mesh shuffled_part(const Communicator& comm, const Mesh& whole) {
  std::mt19937_64 random(7);
  std::vector<std::int32_t> number(whole.points.size());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), random);
  std::vector<Point> points(number.size());
  for (std::size_t i = 0; i < number.size(); ++i) points[number[i]] = whole.points[i];
  auto triangles = whole.triangles;
  std::shuffle(triangles.begin(), triangles.end(), random);
  const std::size_t shares = comm.size() > 1 ? static_cast<std::size_t>(comm.size()) - 1 : 1;
  const std::size_t share = comm.size() > 1 ? static_cast<std::size_t>(comm.rank()) : 1;
  const auto from = [&](std::size_t size) { return share == 0 ? 0 : size * (share - 1) / shares; };
  const auto to = [&](std::size_t size) { return share == 0 ? 0 : size * share / shares; };
  Mesh part;
  part.first_node = static_cast<std::int64_t>(from(points.size()));
  part.owned_nodes = static_cast<std::int32_t>(to(points.size()) - from(points.size()));
  part.points.assign(points.begin() + part.first_node, points.begin() + part.first_node + part.owned_nodes);
  NodeTable nodes(part);
  const auto local = [&](NodeId node) {
    const std::int32_t n = number[node.value()];
    return nodes.local(GlobalNodeId{n}, points[n]);
  };
  for (std::size_t t = from(triangles.size()); t < to(triangles.size()); ++t) {
    part.triangles.push_back({local(triangles[t][0]), local(triangles[t][1]), local(triangles[t][2])});
  }
  for (const BoundaryEdges& b : whole.boundaries) {
    part.boundaries.push_back({b.name, b.condition, {}});
    for (std::size_t e = from(b.edges.size()); e < to(b.edges.size()); ++e) {
      part.boundaries.back().edges.push_back({local(b.edges[e][0]), local(b.edges[e][1])});
    }
  }
  return part;
}

TEST(RestoreDelaunay, AnyDistributionWillDo) {
  const Communicator self(MPI_COMM_SELF);
  const Mesh mesh = delaunay_mesh(self, 0.2);
  const Mesh whole = shuffled_part(self, mesh), part = shuffled_part(world(), mesh);
  expect_same_meshes(gather(world(), part), whole);
  for (const std::int64_t every : {1, 10}) {
    for (unsigned seed = 0; seed < 4; ++seed) move_and_restore(whole, part, every, seed);
  }
}

/// A polygon on a circle, fanned from one of its nodes, and the tip of a triangle across its longest side,
/// the last node, at a distance from the centre.
Mesh polygon_with_tip(std::int32_t corners, double distance) {
  Mesh mesh;
  const auto node = [](std::int32_t i) { return NodeId{i}; };
  for (int i = 0; i < corners; ++i) {
    const double t = std::numbers::pi * (1.0 / 6 + 5.0 / 3 * i / (corners - 1));
    mesh.points.push_back({std::cos(t), std::sin(t)});
  }
  mesh.points.push_back({distance, 0});
  mesh.owned_nodes = corners + 1;
  mesh.boundaries = {{"outline", "wall", {}}};
  for (std::int32_t i = 0; i <= corners; ++i)
    mesh.boundaries[0].edges.push_back({node(i), node((i + 1) % (corners + 1))});
  for (std::int32_t i = 1; i + 1 < corners; ++i) mesh.triangles.push_back({node(0), node(i), node(i + 1)});
  mesh.triangles.push_back({node(0), node(corners - 1), node(corners)});
  return mesh;
}

TEST(RestoreDelaunay, FollowsAsFarAsOneMoveReaches) {
  const Communicator self(MPI_COMM_SELF);
  const Mesh outside = polygon_with_tip(60, 1.2);
  Mesh whole = shuffled_part(self, outside), part = shuffled_part(world(), outside);
  const Point before = outside.points.back(), after{0.95, 0};  // into the circle
  const auto restore = [&](const Communicator& comm, Mesh& mesh) {
    restore_delaunay(comm, mesh, NodeFlags(mesh.points.size(), 1), rank_of);
    NodeFlags moved(mesh.points.size(), 0);
    for (const NodeId node : moved.ids()) {
      Point& p = mesh.points[node.value()];
      if (p != before) continue;
      p = after;
      moved[node] = 1;
    }
    restore_delaunay(comm, mesh, moved, rank_of);
  };
  restore(self, whole);
  restore(world(), part);
  expect_same_meshes(gather(world(), part), whole);
  expect_delaunay(whole);
  for (const auto& t : whole.triangles) {
    EXPECT_TRUE(std::any_of(t.begin(), t.end(), [&](NodeId n) { return whole.point(n) == after; }));
  }
}

}  // namespace
}  // namespace quadloop
