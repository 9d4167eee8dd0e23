// Lines where halved squares of two sizes meet: which of their nodes move, and what becomes of the triangles.
#include "smoother/level_transitions/triangle_lines.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/check/delaunay_check.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "smoother/level_transitions/level_transitions.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/smoother/level_transitions/turns.hpp"
#include "tests/smoother/whole_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop::smoother {
namespace {

using test::self;
using test::upright;
using test::world;

constexpr double line_threshold = 0.05;
constexpr int columns = 12, rows = 9;  ///< of squares of edge 2

/// Squares of edge 2 above a line, halved ones of edge 1 below it, all of them halved: those on the grid's
/// even points by the diagonal through these. The line has corners where `height`, in squares of edge 2,
/// changes from one column to the next.
class Levels {
 public:
  template <class Height, class Place>
  Levels(const Height& height, const Place& place) : place_{place} {
    for (int i = 0; i < columns; ++i) {
      for (int j = 0; j < rows; ++j) {
        if (j >= height(i)) add_large(i, j, height);
        for (int k = 0; k < 4 && j < height(i); ++k) add_square(2 * i + k % 2, 2 * j + k / 2, 1);
      }
    }
    add_rim();
    mesh_.owned_nodes = size32(mesh_.points);
  }
  const Mesh& mesh() const { return mesh_; }
  NodeId at(int x, int y) const { return nodes_.at({x, y}); }

 private:
  using Site = std::array<int, 2>;
  NodeId node(Site s) {
    const auto [found, is_new] = nodes_.try_emplace(s, NodeId{size32(mesh_.points)});
    if (is_new) mesh_.points.push_back(place_(Point(s[0], s[1])));
    return found->second;
  }
  void add(Site a, Site b, Site c) {
    std::array<NodeId, 3> t{node(a), node(b), node(c)};
    if (cross(mesh_.point(t[1]) - mesh_.point(t[0]), mesh_.point(t[2]) - mesh_.point(t[0])) < 0)
      std::swap(t[1], t[2]);
    mesh_.triangles.push_back(t);
  }
  void add_square(int x, int y, int edge) {
    const int i = x / edge % 2, j = y / edge % 2;  // the even corner is this one, or across
    const bool rises = i == j;
    const Site a{x, y}, b{x + edge, y}, c{x + edge, y + edge}, d{x, y + edge};
    add(a, b, rises ? c : d);
    add(rises ? a : b, c, d);
  }
  template <class Height>
  void add_large(int i, int j, const Height& height) {
    const int x = 2 * i, y = 2 * j;
    const bool below = j == height(i), left = i > 0 && j < height(i - 1),
               right = i + 1 < columns && j < height(i + 1);
    if (!below && !left && !right) return add_square(x, y, 2);
    // Seen so that the smaller squares are below, and on the right if they are on two sides.
    const auto at = [&](int u, int v) -> Site {
      if (below) return {left ? x + 2 - u : x + u, y + v};
      return left ? Site{x + v, y + 2 - u} : Site{x + 2 - v, y + u};
    };
    add(at(0, 0), at(1, 0), at(0, 2));
    if (below && (left || right)) {
      add(at(1, 0), at(2, 0), at(2, 1));
      add(at(1, 0), at(2, 1), at(0, 2));
      add(at(2, 1), at(2, 2), at(0, 2));
    } else {
      add(at(1, 0), at(2, 0), at(2, 2));
      add(at(1, 0), at(2, 2), at(0, 2));
    }
  }

  void add_rim() {
    std::set<std::array<NodeId, 2>> edges;
    for (const auto& [a, b, c] : mesh_.triangles) edges.insert({{a, b}, {b, c}, {c, a}});
    mesh_.boundaries = {{"rim", "wall", {}}};
    for (const auto& [from, to] : edges) {
      if (!edges.contains({to, from})) mesh_.boundaries[0].edges.push_back({from, to});
    }
  }

  std::function<Point(Point)> place_;
  Mesh mesh_;
  std::map<Site, NodeId> nodes_;
};

int straight(int) { return 4; }
int stepped(int i) { return i < 4 ? 4 : i < 6 ? 5 : i < 7 ? 6 : i < 10 ? 7 : 5; }

Mesh moved(const Communicator& comm, Mesh part, const std::vector<char>& pinned = {}) {
  HaloMesh halo(comm, part);
  const NodeFlags near(halo.points().size(), 1);
  NodeFlags pins;
  for (const char flag : pinned) pins.push_back(flag);
  move_triangle_lines(comm, halo, near, pins, line_threshold);
  std::copy_n(halo.points().begin(), part.points.size(), part.points.begin());
  return part;
}

TEST(TriangleLines, NodesOfAStraightLineAndThoseBeyondItMove) {
  const Levels levels(straight, upright);
  const Mesh after = moved(self(), levels.mesh());
  const auto expect_up = [&](int x, int y, double up) {
    const Point by = after.point(levels.at(x, y)) - Point(x, y);
    EXPECT_EQ(by.x, 0) << x << " " << y;
    EXPECT_NEAR(by.y, up, 1e-14) << x << " " << y;
  };
  expect_up(1, 8, 0.455);  // hanging
  expect_up(11, 8, 0.455);
  expect_up(12, 8, -0.06);
  expect_up(10, 10, -0.205);  // of more halves of squares than the next one
  expect_up(12, 10, -0.605);
  expect_up(0, 8, 0);  // the rim
  expect_up(11, 7, 0);
  expect_up(12, 12, 0);
}

/// At least as far from the rim as the nodes that have it beside them.
bool is_inner(Point p) { return p.x > 2.5 && p.x < 2 * columns - 2.5 && p.y > 0 && p.y < 2 * rows; }

/// Edges of inner triangles that are not Delaunay.
int count_wrong_edges(const Mesh& mesh) {
  std::map<std::array<NodeId, 2>, NodeId> apexes;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (!is_inner(mesh.point(a)) || !is_inner(mesh.point(b)) || !is_inner(mesh.point(c))) continue;
    apexes.insert({{{a, b}, c}, {{b, c}, a}, {{c, a}, b}});
  }
  int wrong = 0;
  for (const auto& [edge, apex] : apexes) {
    const auto across = apexes.find({edge[1], edge[0]});
    if (across == apexes.end()) continue;
    wrong +=
        in_circle(mesh.point(edge[0]), mesh.point(edge[1]), mesh.point(apex), mesh.point(across->second)) > 0
            ? 1
            : 0;
  }
  return wrong;
}

TEST(TriangleLines, TrianglesBecomeBetterAndStayDelaunay) {
  for (int (*height)(int) : {straight, stepped}) {
    const Mesh before = Levels(height, upright).mesh(), after = moved(self(), before);
    ASSERT_TRUE(is_delaunay(before));
    EXPECT_EQ(count_wrong_edges(after), 0);
    EXPECT_GT(summarise_quality(self(), after).mean, summarise_quality(self(), before).mean + 0.012);
    for (const auto& t : after.triangles) {
      const std::array<Point, 3> p{after.point(t[0]), after.point(t[1]), after.point(t[2])};
      EXPECT_TRUE(!std::ranges::all_of(p, is_inner) || quality_of(p) > 0.78) << p[0].x << " " << p[0].y;
    }
  }
}

TEST(TriangleLines, ImagesOfAMeshMoveAsItDoes) {
  const std::vector<std::function<Point(Point)>> images{[](Point p) {
                                                          return Point{-p.y, p.x};
                                                        },
                                                        [](Point p) {
                                                          return Point{-p.x, -p.y};
                                                        },
                                                        [](Point p) {
                                                          return Point{-p.x, p.y};
                                                        },
                                                        [](Point p) {
                                                          return Point{p.y, p.x};
                                                        }};
  const Mesh after = moved(self(), Levels(stepped, upright).mesh());
  for (const auto& image : images) {
    const Mesh other = moved(self(), Levels(stepped, image).mesh());
    for (std::size_t n = 0; n < other.points.size(); ++n) EXPECT_EQ(other.points[n], image(after.points[n]));
  }
}

TEST(TriangleLines, TheSameOnAnyRanks) {
  const Mesh mesh = Levels(stepped, upright).mesh();
  for (const MeshOrder& order : {space_filling_order(mesh), test::shuffled_order(mesh, 3)}) {
    const Mesh alone = moved(self(), scatter_mesh(self(), mesh, order)),
               part = moved(world(), scatter_mesh(world(), mesh, order));
    for (std::int32_t n = 0; n < size32(part.points); ++n)
      EXPECT_EQ(part.point(NodeId{n}), alone.points[part.global(NodeId{n}).value()]);
  }
}

TEST(TriangleLines, LeaveWhatIsPinnedAndWhatIsOfNoLine) {
  const auto expect_stays = [](const Mesh& mesh, char pinned) {
    EXPECT_TRUE(moved(self(), mesh, std::vector<char>(mesh.points.size(), pinned)).points == mesh.points);
  };
  expect_stays(Levels(stepped, upright).mesh(), 1);
  expect_stays(Levels([](int) { return -1; }, upright).mesh(), 0);  // all of one size
  expect_stays(Levels(straight, [](Point p) { return Point{p.x + 0.01 * p.y, p.y}; }).mesh(), 0);
}

}  // namespace
}  // namespace quadloop::smoother
