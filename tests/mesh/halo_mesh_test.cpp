// Each rank has all cells and boundary edges that touch its nodes, in their global order, and values reach
// the ranks that have copies.
#include "mesher/mesh/halo_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "mesher/base/ids.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;
using Numbers = std::vector<std::int64_t>;

/// A mesh as a whole, nodes and cells in the order of the parts, and this rank's part of it.
struct Pieces {
  Pieces(const Mesh& mesh, const MeshOrder& order)
      : whole{scatter_mesh(Communicator(MPI_COMM_SELF), mesh, order)},
        part{scatter_mesh(world(), mesh, order)},
        first_triangle{world().exclusive_sum(std::ssize(part.triangles))},
        first_quad{world().exclusive_sum(std::ssize(part.quads))} {}

  bool is_owned(NodeId number) const {
    return part.first_node <= number.value() && number.value() < part.first_node + part.owned_nodes;
  }

  Mesh whole, part;
  std::int64_t first_triangle, first_quad;
};

/// Calls `check(pieces)` for several meshes and orders.
template <class Check>
void for_each_distribution(const Check& check) {
  for (const std::int32_t n : {1, 2, 9}) {
    const test::Grid grid{n};
    Mesh mesh = grid.mesh();
    test::jitter(grid, 0.2, 3, mesh);
    for (const MeshOrder& order : {space_filling_order(mesh), test::shuffled_order(mesh, 12)})
      check(Pieces(mesh, order));
  }
}

/// Of the cells that this rank must have, in global order: their numbers among triangles or quads.
template <class Cells>
Numbers expected_numbers(const Pieces& pieces, const Cells& cells, std::int64_t first_own, std::size_t own) {
  Numbers numbers;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto number = static_cast<std::int64_t>(c);
    const bool is_own = first_own <= number && number < first_own + static_cast<std::int64_t>(own);
    if (is_own || std::any_of(cells[c].begin(), cells[c].end(), [&](NodeId n) { return pieces.is_owned(n); }))
      numbers.push_back(number);
  }
  return numbers;
}

/// The same as rows of nodes, triangles, then quads.
std::vector<Numbers> expected_cells(const Pieces& pieces) {
  std::vector<Numbers> rows;
  const auto add = [&](const auto& cells, const Numbers& numbers) {
    for (const std::int64_t number : numbers) {
      rows.emplace_back();
      for (const NodeId node : cells[number]) rows.back().push_back(node.value());
    }
  };
  add(pieces.whole.triangles,
      expected_numbers(pieces, pieces.whole.triangles, pieces.first_triangle, pieces.part.triangles.size()));
  add(pieces.whole.quads,
      expected_numbers(pieces, pieces.whole.quads, pieces.first_quad, pieces.part.quads.size()));
  return rows;
}

TEST(HaloMesh, HasAllCellsRoundOwnedNodesInGlobalOrder) {
  for_each_distribution([](const Pieces& pieces) {
    const HaloMesh halo(world(), pieces.part);
    std::vector<Numbers> rows;
    halo.for_each_cell([&](const auto& nodes) {
      rows.emplace_back();
      for (const NodeId node : nodes) rows.back().push_back(halo.global(node).value());
    });
    EXPECT_TRUE(rows == expected_cells(pieces));
  });
}

TEST(HaloMesh, KnowsWhereItsNodesAre) {
  for_each_distribution([](const Pieces& pieces) {
    const HaloMesh halo(world(), pieces.part);
    EXPECT_EQ(halo.owned_nodes(), pieces.part.owned_nodes);
    Numbers numbers;
    for (const NodeId node : ids_below(NodeId{size32(halo.points())})) {
      numbers.push_back(halo.global(node).value());
      EXPECT_EQ(halo.point(node), pieces.whole.points[numbers.back()]);
    }
    std::sort(numbers.begin(), numbers.end());
    EXPECT_EQ(std::adjacent_find(numbers.begin(), numbers.end()), numbers.end()) << "a node is there twice";
  });
}

TEST(HaloMesh, HasAllBoundaryEdgesAtOwnedNodesOnce) {
  for_each_distribution([](const Pieces& pieces) {
    const HaloMesh halo(world(), pieces.part);
    std::vector<Numbers> found, expected;
    for (const HaloEdge& e : halo.boundary_edges()) {
      ASSERT_TRUE(e.from.valid() && e.to.valid());
      if (halo.owns(e.from) || halo.owns(e.to))
        found.push_back({halo.global(e.from).value(), halo.global(e.to).value(), e.boundary});
    }
    for (std::size_t b = 0; b < pieces.whole.boundaries.size(); ++b) {
      for (const auto& [from, to] : pieces.whole.boundaries[b].edges) {
        if (pieces.is_owned(from) || pieces.is_owned(to))
          expected.push_back({from.value(), to.value(), static_cast<std::int64_t>(b)});
      }
    }
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_TRUE(found == expected);
  });
}

TEST(HaloMesh, SpreadsTheCellsValues) {
  for_each_distribution([](const Pieces& pieces) {
    const HaloMesh halo(world(), pieces.part);
    Numbers own(pieces.part.triangles.size() + pieces.part.quads.size());
    const auto quads_begin = own.begin() + static_cast<std::ptrdiff_t>(pieces.part.triangles.size());
    std::iota(own.begin(), quads_begin, pieces.first_triangle);
    std::iota(quads_begin, own.end(), pieces.first_quad);
    Numbers expected =
        expected_numbers(pieces, pieces.whole.triangles, pieces.first_triangle, pieces.part.triangles.size());
    const Numbers quads =
        expected_numbers(pieces, pieces.whole.quads, pieces.first_quad, pieces.part.quads.size());
    expected.insert(expected.end(), quads.begin(), quads.end());
    EXPECT_TRUE(halo.spread(world(), own) == expected);
  });
}

TEST(HaloMesh, ExchangeBringsTheOwnersValues) {
  for_each_distribution([](const Pieces& pieces) {
    const HaloMesh halo(world(), pieces.part);
    const auto value_of = [&](NodeId node) { return 0.5 * static_cast<double>(halo.global(node).value()); };
    IdVector<NodeId, double> values(halo.points().size(), -1);
    for (const NodeId node : ids_below(NodeId{halo.owned_nodes()})) values[node] = value_of(node);
    halo.exchange().update(values);
    for (const NodeId node : values.ids()) EXPECT_EQ(values[node], value_of(node));
  });
}

TEST(HaloMesh, ExchangeBringsOnlyWhatHasChanged) {
  for_each_distribution([](const Pieces& pieces) {
    const HaloMesh halo(world(), pieces.part);
    const auto is_even = [&](std::int32_t node) { return halo.global(NodeId{node}).value() % 2 == 0; };
    IdVector<NodeId, GlobalNodeId> values(halo.points().size());
    for (const NodeId node : ids_below(NodeId{halo.owned_nodes()})) values[node] = halo.global(node);
    halo.exchange().update(values, is_even);
    for (const NodeId node : values.ids()) {
      const bool known = halo.owns(node) || is_even(node.value());
      EXPECT_EQ(values[node], known ? halo.global(node) : GlobalNodeId{});
    }
  });
}

TEST(NodeFlags, EachFlaggedNodeIsVisitedInOrderAndMayLoseItsFlag) {
  for (const std::int32_t size : {0, 1, 7, 8, 9, 24, 65}) {
    for (std::int32_t step = 1; step <= 17; step += 4) {
      NodeFlags flags(size, 0);
      std::vector<NodeId> expected, found;
      for (std::int32_t i = step - 1; i < size; i += step) expected.push_back(NodeId{i});
      flag_all(expected, flags);
      for_each_flagged(flags, [&](NodeId node) {
        found.push_back(node);
        flags[node] = 0;
      });
      EXPECT_EQ(found, expected) << size << ' ' << step;
      EXPECT_EQ(flags, NodeFlags(size, 0));
    }
  }
}

}  // namespace
}  // namespace quadloop
