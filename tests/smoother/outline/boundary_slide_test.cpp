// Which boundary nodes may move, and that they keep to the boundary.
#include "smoother/outline/boundary_slide.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "smoother/sweeps/node_stars.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/smoother/whole_meshes.hpp"

namespace quadloop::smoother {
namespace {

using test::self;

/// A mesh with the slide along its boundaries, whole on this rank.
struct Sliding {
  explicit Sliding(Mesh given, const Geometry* geometry = nullptr, NodeFlags pinned_nodes = {})
      : mesh{std::move(given)}, halo(self(), mesh), pinned{std::move(pinned_nodes)} {
    if (geometry != nullptr) path.emplace(*geometry);
    slide.emplace(self(), halo, mesh.boundaries, path ? &*path : nullptr, pinned);
    const auto owned = ids_below(NodeId{mesh.owned_nodes});
    stars.emplace(halo, std::vector<NodeId>(owned.begin(), owned.end()), std::vector<CellTarget>{});
  }
  std::optional<Point> improved(NodeId node, double even_up_to = 0) {
    Star star;
    stars->gather(node.value(), star);
    return slide->improve(node, star, Objective::power, even_up_to);
  }
  Mesh mesh;
  HaloMesh halo;
  NodeFlags pinned;
  std::optional<OutlinePath> path;
  std::optional<BoundarySlide> slide;
  std::optional<NodeStars> stars;
};

constexpr test::Grid grid{6, {1, 1}, true};

bool at_corner(Point p) { return (p.x == 0 || p.x == 1) && (p.y == 0 || p.y == 1); }

TEST(BoundarySlide, StraightSidesSlideAndCornersStay) {
  Sliding s(grid.mesh());
  for (std::int32_t node = 0; node < s.mesh.owned_nodes; ++node) {
    const NodeFreedom expected = grid.inner(node)                        ? NodeFreedom::interior
                                 : at_corner(s.mesh.point(NodeId{node})) ? NodeFreedom::fixed
                                                                         : NodeFreedom::sliding;
    EXPECT_EQ(s.slide->freedom(NodeId{node}), expected) << node;
  }
}

TEST(BoundarySlide, PinnedNodesStay) {
  NodeFlags pinned(49, 0);
  pinned[NodeId{3}] = pinned[NodeId{24}] = 1;  // on the lower side, inside
  Sliding s(grid.mesh(), nullptr, pinned);
  EXPECT_EQ(s.slide->freedom(NodeId{3}), NodeFreedom::fixed);
  EXPECT_EQ(s.slide->freedom(NodeId{24}), NodeFreedom::fixed);
  EXPECT_EQ(s.slide->freedom(NodeId{2}), NodeFreedom::sliding);
}

TEST(BoundarySlide, ABoundaryThatIsBentWithoutAnOutlineStays) {
  Mesh mesh = grid.mesh();
  mesh.points.begin()[3].y = -1e-6;
  Sliding s(std::move(mesh));
  for (const int node : {2, 3, 4}) EXPECT_EQ(s.slide->freedom(NodeId{node}), NodeFreedom::fixed) << node;
  EXPECT_EQ(s.slide->freedom(NodeId{1}), NodeFreedom::sliding);
}

TEST(BoundarySlide, WhereBoundariesMeetOnAStraightSideTheNodeStays) {
  Mesh mesh = grid.mesh();
  BoundaryEdges half{"half", "wall", {}};
  auto& edges = mesh.boundaries[0].edges;
  std::erase_if(edges, [&](const auto& edge) {
    const bool of_half =
        mesh.point(edge[0]).y == 0 && mesh.point(edge[1]).y == 0 && mesh.point(edge[1]).x < 0.51;
    if (of_half) half.edges.push_back(edge);
    return of_half;
  });
  ASSERT_EQ(half.edges.size(), 3U);
  mesh.boundaries.push_back(half);
  Sliding s(std::move(mesh));
  EXPECT_EQ(s.slide->freedom(NodeId{3}), NodeFreedom::fixed);
  EXPECT_EQ(s.slide->freedom(NodeId{2}), NodeFreedom::sliding);
}

TEST(BoundarySlide, ANodeNearANeighbourMovesAwayAlongTheSide) {
  Mesh mesh = grid.mesh();
  mesh.points.begin()[3].x = 0.36;  // from 0.5, beside that at 0.333
  Sliding s(std::move(mesh));
  const auto better = s.improved(NodeId{3});
  ASSERT_TRUE(better.has_value());
  EXPECT_EQ(better->y, 0);
  EXPECT_GT(better->x, 0.36);
  EXPECT_LT(better->x, 2.0 / 3) << "it never passes a neighbour";
}

double longer_by_shorter(double back, double ahead) { return std::max(back, ahead) / std::min(back, ahead); }

TEST(BoundarySlide, EdgesStayEvenUnlessCellsNeedTheRoom) {
  constexpr double costly = 0.3, third = 1.0 / 3;
  Mesh mesh = grid.mesh();
  mesh.points.begin()[10].x = 0.6;  // above node 3, from 0.5: cells are best with the node under it
  Sliding even(mesh);
  const auto held = even.improved(NodeId{3}, costly), freed = even.improved(NodeId{3}, 0);
  ASSERT_TRUE(held.has_value() && freed.has_value());
  EXPECT_GT(held->x, 0.5);
  EXPECT_LE(longer_by_shorter(held->x - third, 2 * third - held->x), 1.5);
  EXPECT_GT(longer_by_shorter(freed->x - third, 2 * third - freed->x), 1.5);

  mesh.points.begin()[3].x = 0.55;
  const double before = longer_by_shorter(0.55 - third, 2 * third - 0.55);
  Sliding uneven(std::move(mesh));
  const auto further = uneven.improved(NodeId{3}, 0);
  ASSERT_TRUE(further.has_value());
  EXPECT_GT(longer_by_shorter(further->x - third, 2 * third - further->x), before);
  EXPECT_FALSE(uneven.improved(NodeId{3}, costly).has_value()) << "it would be more uneven than it was";
}

/// A grid bent to a disc of 64 sides.
struct OnTheCircle {
  Geometry polygon = test::circle(64);
  Mesh mesh = test::disc(test::Grid{8, {1, 1}, true}, polygon);
};

TEST(BoundarySlide, NodesOnACurvedOutlineSlideAlongIt) {
  const OnTheCircle c;
  Sliding without(c.mesh), with(c.mesh, &c.polygon);
  int sliding = 0, moved = 0;
  for (const BoundaryEdges& boundary : c.mesh.boundaries) {
    for (const auto& edge : boundary.edges) {
      const NodeId node = edge[0];
      EXPECT_EQ(without.slide->freedom(node), NodeFreedom::fixed);
      if (with.slide->freedom(node) != NodeFreedom::sliding) continue;
      ++sliding;
      const auto better = with.improved(node);
      if (!better) continue;
      ++moved;
      EXPECT_LT(with.path->distance(*better, boundary.name, 0.1), 1e-12);
      EXPECT_LT(length(*better - c.mesh.point(node)), 0.5);
    }
  }
  EXPECT_GT(sliding, 20);
  EXPECT_GT(moved, 0);
}

/// A grid inside a square outline of 4 segments, wall to the south and east.
struct InASquare {
  InASquare() {
    mesh.points.begin()[3].x = 0.4;  // from 0.5, on the lower side
  }
  Geometry square{{{"wall", 0, 30, "wall"}, {"far", 0, 30, "none"}},
                  {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                  {0, 4},
                  {BoundaryId{0}, BoundaryId{0}, BoundaryId{1}, BoundaryId{1}}};
  Mesh mesh = grid.mesh();
};

TEST(BoundarySlide, TellsWhichNodesLieOnFlaggedSegments) {
  const InASquare in;
  Sliding s(in.mesh, &in.square);
  const std::vector<double> south{1, 0, 0, 0}, none(4, 0);
  for (const int node : {1, 2, 3, 4, 5}) {
    EXPECT_TRUE(s.slide->lies_on(NodeId{node}, south)) << node;
    EXPECT_FALSE(s.slide->lies_on(NodeId{node}, none)) << node;
  }
  EXPECT_FALSE(s.slide->lies_on(NodeId{13}, south)) << "on the east side";
  EXPECT_FALSE(Sliding(in.mesh).slide->lies_on(NodeId{3}, south)) << "without an outline";
}

TEST(BoundarySlide, AnEighthOfTheDifferenceTowardsTheMiddle) {
  InASquare in;
  const auto moved = [&](int node) {
    Sliding s(in.mesh, &in.square);
    Star star;
    s.stars->gather(node, star);
    return s.slide->towards_middle(NodeId{node}, star, std::vector<Point>(in.mesh.points.size()));
  };
  const auto to = moved(3);
  ASSERT_TRUE(to.has_value());
  EXPECT_EQ(to->y, 0);
  EXPECT_NEAR(to->x, 0.4 + 0.125 * ((2.0 / 3 - 0.4) - (0.4 - 1.0 / 3)), 1e-12);
  in.mesh.points.begin()[3].x = 0.5 + 1e-5;
  EXPECT_FALSE(moved(3).has_value()) << "even enough";
}

TEST(BoundarySlide, NoAngleFallsUnder28DegreesOnTheWayToTheMiddle) {
  InASquare in;
  in.mesh.points.begin()[3].x = 0.36;
  in.mesh.points.begin()[10].x = 0.10;  // above it, far to the left: a move to the right flattens the cell
  Sliding s(in.mesh, &in.square);
  Star star;
  s.stars->gather(3, star);
  const std::vector<Point> none(in.mesh.points.size());
  EXPECT_FALSE(s.slide->towards_middle(NodeId{3}, star, none).has_value());
}

TEST(BoundarySlide, BesideANodeThatStaysTheWidthBeyondItCountsToo) {
  InASquare in;
  in.mesh.points.begin()[13].y = 0.05;  // east of the corner, node 6
  Sliding s(in.mesh, &in.square);
  const std::vector<Point> fixed = s.slide->widths_at_fixed(std::vector<double>{1, 1, 0, 0});
  EXPECT_NEAR(fixed[6].x, 1.0 / 6, 1e-12);
  EXPECT_NEAR(fixed[6].y, 0.05, 1e-12);
  EXPECT_EQ(fixed[5], Point()) << "it slides";
  EXPECT_EQ(s.slide->widths_at_fixed(std::vector<double>(4, 0))[6], Point());
  const auto moved = [&](int node, const std::vector<Point>& widths) {
    Star star;
    s.stars->gather(node, star);
    return s.slide->towards_middle(NodeId{node}, star, widths);
  };
  EXPECT_FALSE(moved(5, std::vector<Point>(fixed.size())).has_value()) << "in the middle";
  const auto to = moved(5, fixed);
  ASSERT_TRUE(to.has_value());
  EXPECT_NEAR(to->x, 5.0 / 6 + 0.25 * (1.0 / 6 - std::sqrt(0.05 / 6)), 1e-12);
}

TEST(BoundarySlide, HeightsAreThoseOfTheSegmentInTheMiddleOfAnEdge) {
  InASquare in;
  Sliding s(in.mesh, &in.square);
  const std::vector<double> heights{3, 4, 0, 0};
  EXPECT_EQ(s.slide->height_at({NodeId{5}, NodeId{6}, 0}, heights), 3);
  EXPECT_EQ(s.slide->height_at({NodeId{6}, NodeId{13}, 0}, heights), 4);
  EXPECT_NEAR(s.slide->unevenness(NodeId{3}), (2.0 / 3 - 0.4) / (0.4 - 1.0 / 3), 1e-12);
}

/// Nodes where one edge of the boundary is more than 1.5 times as long as the next.
int uneven_nodes(const Mesh& mesh) {
  std::vector<double> back(mesh.points.size()), ahead(mesh.points.size());
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& [from, to] : boundary.edges)
      ahead[from.value()] = back[to.value()] = length(mesh.point(to) - mesh.point(from));
  }
  int uneven = 0;
  for (std::size_t node = 0; node < back.size(); ++node)
    uneven += back[node] > 0 && longer_by_shorter(back[node], ahead[node]) > 1.5 ? 1 : 0;
  return uneven;
}

TEST(BoundarySlide, SmoothingMakesNoMoreEdgesUneven) {
  const Geometry polygon = test::circle(240);
  SmoothOptions options;
  options.geometry = &polygon;
  const Mesh before = test::disc(test::Grid{16, {1, 1}, false}, polygon);
  EXPECT_LE(uneven_nodes(test::smoothed_alone(before, options)), uneven_nodes(before));
}

TEST(BoundarySlide, AnOutlineOfOtherNamesIsNone) {
  OnTheCircle c;
  for (BoundaryEdges& boundary : c.mesh.boundaries) boundary.name += " of another";
  Sliding s(c.mesh, &c.polygon);
  for (const BoundaryEdges& boundary : c.mesh.boundaries) {
    for (const auto& edge : boundary.edges) EXPECT_EQ(s.slide->freedom(edge[0]), NodeFreedom::fixed);
  }
}

}  // namespace
}  // namespace quadloop::smoother
