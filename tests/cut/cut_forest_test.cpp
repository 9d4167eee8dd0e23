// A whole forest cut: what lies in, what out, and the parts that fill the outline.
#include "mesher/cut/cut_forest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/build/sized_domain.hpp"
#include "mesher/forest/refine_forest.hpp"
#include "mesher/geometry/predicates.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

/// A star of five points, each of them a corner that is kept, with a triangle of void in it.
Geometry star_with_hole() {
  std::vector<Point> points;
  for (int i = 0; i < 10; ++i) {
    const double angle = std::numbers::pi * (i / 5.0 + 0.013), r = i % 2 == 0 ? 2 : 0.9;
    points.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  for (const Point p : {Point{0.3, 0.1}, Point{-0.2, -0.35}, Point{-0.1, 0.4}}) points.push_back(p);
  std::vector<BoundaryId> boundary(10, BoundaryId{0});
  boundary.resize(13, BoundaryId{1});
  return {{{"star", 0.1, 10, "wall"}, {"hole", 0.05, 10, "wall"}}, points, {0, 10, 13}, boundary};
}

double area_inside(const Geometry& geometry) {
  double twice = 0;
  for (std::int32_t v = 0; v < geometry.size(); ++v)
    twice += cross(geometry.point(v), geometry.point(geometry.next(v)));
  return twice / 2;
}

struct Cut {
  Cut(const Communicator& comm, double snap)
      : domain{geometry, options(), demanded},
        graph{refine_forest(comm, domain.sizes)},
        cut{cut_forest(comm, graph, domain.sizes, domain.outline, domain.inside, snap)} {}
  static const SizeOptions& options() {
    static const SizeOptions sizes = [] {
      SizeOptions size;
      size.min = 0.02;
      size.max = 0.25;
      return size;
    }();
    return sizes;
  }
  const Quadrant& leaf(std::size_t local) const {
    return graph.leaf(graph.local_begin() + static_cast<std::int32_t>(local));
  }
  /// Of the cells of a cut leaf, and of its nodes what `visit` wants to see.
  template <class Visit>
  double area_of(const CutForest::Entry& entry, const Visit& visit) const {
    double twice = 0;
    const auto add = [&](const auto& cell) {
      for (std::size_t k = 0; k < cell.size(); ++k) {
        const Point a = cut.nodes[entry.begin.nodes + cell[k]].position;
        const Point b = cut.nodes[entry.begin.nodes + cell[(k + 1) % cell.size()]].position;
        const Point c = cut.nodes[entry.begin.nodes + cell[(k + 2) % cell.size()]].position;
        EXPECT_GT(orientation(a, b, c), 0);
        twice += cross(a, b);
        visit(a);
      }
    };
    for (const auto& t : CutForest::part(cut.triangles, entry.begin.triangles, entry.end.triangles)) add(t);
    for (const auto& q : CutForest::part(cut.quads, entry.begin.quads, entry.end.quads)) add(q);
    return twice / 2;
  }

  Geometry geometry = star_with_hole();
  DemandedSplits demanded;
  SizedDomain domain;
  LeafGraph graph;
  CutForest cut;
};

TEST(CutForest, UncutLeavesLieInOrOutWhole) {
  for (const double snap : {0.0, 0.4}) {
    const Cut c(world(), snap);
    std::int64_t cut_leaves = 0;
    for (std::size_t i = 0; i < c.cut.states.size(); ++i) {
      if (c.cut.states[i] == CutForest::State::cut) {
        ++cut_leaves;
        EXPECT_GE(c.cut.entry_of[i], 0);
        continue;
      }
      const bool inside = c.domain.inside.contains(c.domain.lattice.box_of(c.leaf(i)).centre());
      EXPECT_EQ(c.cut.states[i] == CutForest::State::inside, inside);
    }
    EXPECT_GT(world().sum(cut_leaves), 100);
  }
}

TEST(CutForest, WithoutSnapsCellsFillTheOutlineAndKeepToTheirLeaves) {
  const Cut c(world(), 0);
  EXPECT_TRUE(c.cut.moved.empty());
  double area = 0;
  for (std::size_t i = 0; i < c.cut.states.size(); ++i) {
    const Box box = c.domain.lattice.box_of(c.leaf(i));
    if (c.cut.states[i] == CutForest::State::inside) area += box.width() * box.height();
    if (c.cut.states[i] != CutForest::State::cut) continue;
    area += c.area_of(c.cut.entries[c.cut.entry_of[i]], [&](Point p) { EXPECT_TRUE(box.contains(p)); });
  }
  double all = 0;
  for (const double part : world().all_gather(area)) all += part;
  EXPECT_NEAR(all, area_inside(c.geometry), 1e-12);
}

TEST(CutForest, SnapsMoveLatticeCornersOntoTheOutline) {
  const Cut c(world(), 0.4);
  EXPECT_GT(world().sum(std::ssize(c.cut.moved)), 20);
  for (const CutForest::Moved& moved : c.cut.moved) {
    const Point from = c.domain.lattice.corner(moved.corner);
    EXPECT_LT(length(moved.position - from), 0.25);
    EXPECT_NE(moved.position, from);
  }
}

/// What each leaf has become, in the order of the curve.
struct Outcome {
  std::int64_t x, y, state, cells;
  double area;
  friend bool operator==(const Outcome&, const Outcome&) = default;
};
std::vector<Outcome> outcomes(const Communicator& comm, double snap) {
  const Cut c(comm, snap);
  std::vector<Outcome> own;
  for (std::size_t i = 0; i < c.cut.states.size(); ++i) {
    Outcome o{c.leaf(i).x, c.leaf(i).y, static_cast<std::int64_t>(c.cut.states[i]), 0, 0};
    if (c.cut.states[i] == CutForest::State::cut) {
      const CutForest::Entry& entry = c.cut.entries[c.cut.entry_of[i]];
      o.cells = entry.end.triangles - entry.begin.triangles + 1000 * (entry.end.quads - entry.begin.quads);
      o.area = c.area_of(entry, [](Point) {});
    }
    own.push_back(o);
  }
  return comm.all_gather_values(std::span<const Outcome>(own));
}

TEST(CutForest, IsTheSameOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  for (const double snap : {0.0, 0.4}) EXPECT_EQ(outcomes(world(), snap), outcomes(self, snap));
}

TEST(ResolutionTest, ALeafMustShowWhatItHolds) {
  const Geometry geometry = star_with_hole();
  const DemandedSplits none;
  SizedDomain domain(geometry, Cut::options(), none);
  const auto unresolved = [&](const Quadrant& q) {
    std::vector<std::int32_t> segments;
    for (std::int32_t s = 0; s < geometry.size(); ++s) {
      if (domain.outline.meets(s, domain.lattice.box_of(q))) segments.push_back(s);
    }
    return domain.resolution.unresolved(q, segments);
  };
  EXPECT_TRUE(unresolved({})) << "two whole loops";
  Quadrant at_tip;  // down to a leaf with one point of the star
  const Point tip = geometry.point(0);
  while (at_tip.level < 8) {
    for (const Corner quarter : corners_along_curve) {
      const Quadrant child = at_tip.child(quarter);
      if (!domain.lattice.box_of(child).contains(tip)) continue;
      at_tip = child;
      break;
    }
  }
  EXPECT_FALSE(unresolved(at_tip));
}

}  // namespace
}  // namespace quadloop
