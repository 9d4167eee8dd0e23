// Chords on the two sides of a leaf's side: which of them cancel.
#include "mesher/cut/opposed_chords.hpp"

#include <gtest/gtest.h>

#include "tests/support/world.hpp"

namespace quadloop {
namespace {

/// The square from 0 to 2 in four leaves, cut by hand: each of its leaves has the chords that are given for
/// it.
class FourLeaves {
 public:
  /// *Collective.*
  FourLeaves() : graph{test::world(), lattice, Forest(test::world(), lattice)} {
    const auto local = static_cast<std::size_t>(graph.local_end() - graph.local_begin());
    cut.states.assign(local, CutForest::State::outside);
    cut.entry_of.assign(local, -1);
  }

  /// Of the leaf in this quarter, where it is this rank's.
  void add(Corner quarter, const std::vector<std::array<CutLeaf::Node, 2>>& chords) {
    const std::int32_t leaf = graph.leaf_at(lattice_place(quarter).x, lattice_place(quarter).y);
    if (!graph.is_local(leaf)) return;
    cut.states[leaf - graph.local_begin()] = CutForest::State::cut;
    cut.entry_of[leaf - graph.local_begin()] = size32(cut.entries);
    CutForest::Entry entry;
    entry.begin = {size32(cut.nodes), 0, 0, size32(cut.outline)};
    for (const auto& [from, to] : chords) {
      const std::int32_t first = size32(cut.nodes) - entry.begin.nodes;
      cut.nodes.push_back(from);
      cut.nodes.push_back(to);
      cut.outline.push_back({first, first + 1, 0});
    }
    entry.end = {size32(cut.nodes), 0, 0, size32(cut.outline)};
    cut.entries.push_back(entry);
  }

  std::vector<Point> ends() const {
    const auto own = OpposedChords(test::world(), graph, cut).ends();
    EXPECT_TRUE(std::is_sorted(own.begin(), own.end()));
    auto all = test::world().all_gather_values(std::span<const Point>(own));
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

 private:
  static LatticePoint lattice_place(Corner quarter) { return Quadrant{}.child(quarter).at(Site::south_west); }

  const Lattice lattice{{{0, 0}, {2, 2}}, 1, 1};
  LeafGraph graph;
  CutForest cut;
};

CutLeaf::Node node(double x, double y, Site site) { return {{x, y}, site}; }

TEST(OpposedChords, CancelOnTheTwoSidesOfASide) {
  FourLeaves leaves;
  leaves.add(Corner::south_west, {{node(1, 0.25, Site::on_right), node(1, 0.5, Site::right_middle)}});
  leaves.add(Corner::south_east, {{node(1, 0.5, Site::left_middle), node(1, 0.25, Site::on_left)}});
  EXPECT_EQ(leaves.ends(), (std::vector<Point>{{1, 0.25}, {1, 0.5}}));
}

TEST(OpposedChords, OfOneDirectionDoNotCancel) {
  FourLeaves leaves;
  leaves.add(Corner::south_west, {{node(1, 0.25, Site::on_right), node(1, 0.5, Site::right_middle)}});
  leaves.add(Corner::south_east, {{node(1, 0.25, Site::on_left), node(1, 0.5, Site::left_middle)}});
  EXPECT_TRUE(leaves.ends().empty());
}

TEST(OpposedChords, OfOtherEndsDoNotCancel) {
  FourLeaves leaves;
  leaves.add(Corner::south_west, {{node(1, 0.25, Site::on_right), node(1, 0.5, Site::right_middle)}});
  leaves.add(Corner::south_east, {{node(1, 0.75, Site::on_left), node(1, 0.25, Site::on_left)}});
  EXPECT_TRUE(leaves.ends().empty());
}

TEST(OpposedChords, ThroughALeafAreNone) {
  FourLeaves leaves;
  leaves.add(Corner::south_west, {{node(1, 0.5, Site::right_middle), node(0.5, 1, Site::top_middle)}});
  leaves.add(Corner::north_east, {{node(0.5, 1, Site::inside), node(1, 0.5, Site::inside)}});
  EXPECT_TRUE(leaves.ends().empty());
}

TEST(OpposedChords, EndOnceWhereTwoPairsMeet) {
  FourLeaves leaves;
  leaves.add(Corner::north_west, {{node(0.25, 1, Site::on_bottom), node(0.5, 1, Site::bottom_middle)},
                                  {node(0.5, 1, Site::bottom_middle), node(1, 1, Site::south_east)}});
  leaves.add(Corner::south_west, {{node(1, 1, Site::north_east), node(0.5, 1, Site::top_middle)},
                                  {node(0.5, 1, Site::top_middle), node(0.25, 1, Site::on_top)}});
  EXPECT_EQ(leaves.ends(), (std::vector<Point>{{0.25, 1}, {0.5, 1}, {1, 1}}));
}

TEST(OpposedChords, OfNoCutLeafAreNone) { EXPECT_TRUE(FourLeaves().ends().empty()); }

}  // namespace
}  // namespace quadloop
