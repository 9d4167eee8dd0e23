// Parts are the same on any number of ranks, valid meshes, agree with their neighbours, and make up the
// whole.
#include <gtest/gtest.h>
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "mesher/base/error.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/part_names.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "mesher/partition/hilbert.hpp"
#include "mesher/partition/join_parts.hpp"
#include "mesher/partition/mesh_part.hpp"
#include "mesher/partition/part_strips.hpp"
#include "mesher/partition/partition.hpp"
#include "mesher/partition/refine_sides.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/mixed_square.hpp"
#include "tests/mesh/same_meshes.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

Mesh grid() {
  const test::Grid grid{.n = 17, .size = {3, 1}};
  Mesh mesh = grid.mesh();
  test::jitter(grid, 0.2, 7, mesh);
  return mesh;
}

Field field_of(const Mesh& whole) {
  Field field{{"density", "pressure"}, {}, {3, 0.5}};
  for (std::int32_t i = 0; i < whole.owned_nodes; ++i)
    field.values.insert(field.values.end(), {whole.points[i].x + 0.1, 1.0 / (i + 1)});
  field.cells.names = {"volume", "level"};
  for (std::size_t i = 0; i < whole.triangles.size() + whole.quads.size(); ++i)
    field.cells.values.insert(field.cells.values.end(),
                              {1.0 / static_cast<double>(i + 3), static_cast<double>(i)});
  return field;
}

/// All parts of a mesh that one rank divides alone.
std::vector<MeshPart> all_parts(const Mesh& whole, std::int32_t parts, const Field* field = nullptr) {
  const Communicator alone(MPI_COMM_SELF);
  return make_parts(alone, whole, partition(alone, whole, parts), field);
}

void expect_equal(const MeshPart& a, const MeshPart& b) {
  EXPECT_EQ(a.number, b.number);
  test::expect_same_meshes(a.mesh, b.mesh);
  EXPECT_EQ(a.mesh.owned_nodes, b.mesh.owned_nodes);
  EXPECT_EQ(a.nodes, b.nodes);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.quads, b.quads);
  EXPECT_EQ(a.owners, b.owners);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.neighbours, b.neighbours);
  ASSERT_EQ(a.field.has_value(), b.field.has_value());
  if (a.field) {
    EXPECT_EQ(a.field->values, b.field->values);
    EXPECT_EQ(a.field->cells.names, b.field->cells.names);
    EXPECT_EQ(a.field->cells.values, b.field->cells.values);
  }
}

JoinedMesh joined(const Mesh& whole, const std::vector<MeshPart>& parts) {
  WholeCounts counts{size32(whole.points), size32(whole.triangles), size32(whole.quads), {}};
  std::vector<BoundaryEdges> boundaries = whole.boundaries;
  for (BoundaryEdges& boundary : boundaries) counts.edges.push_back(size32(boundary.edges));
  for (BoundaryEdges& boundary : boundaries) boundary.edges.clear();
  PartJoiner fresh(counts, boundaries, whole.blocks.names);
  for (const MeshPart& part : parts) fresh.put(part, part_name(part.number));
  return fresh.finish("the set");
}

/// By boundary name, the edges of a part with the numbers of the whole, each as its neighbour walks it.
std::vector<std::array<std::int64_t, 2>> edges_to(const MeshPart& part, const std::string& name,
                                                  bool turned) {
  std::vector<std::array<std::int64_t, 2>> edges;
  for (const BoundaryEdges& boundary : part.mesh.boundaries) {
    if (boundary.name != name) continue;
    for (const auto& [from, to] : boundary.edges) {
      edges.push_back({part.nodes[from.value()], part.nodes[to.value()]});
      if (turned) std::swap(edges.back()[0], edges.back()[1]);
    }
  }
  return edges;
}

std::vector<std::int64_t> numbers_shared(const MeshPart& part, std::int32_t with) {
  std::vector<std::int64_t> numbers;
  for (const MeshPart::Neighbour& neighbour : part.neighbours) {
    if (neighbour.part != with) continue;
    for (const NodeId node : neighbour.nodes) numbers.push_back(part.nodes[node.value()]);
  }
  return numbers;
}

Mesh without_empty_boundaries(Mesh mesh) {
  std::erase_if(mesh.boundaries, [](const BoundaryEdges& boundary) { return boundary.edges.empty(); });
  return mesh;
}

TEST(Hilbert, NeighboursOnTheCurveShareASide) {
  constexpr std::uint32_t n = 16, shift = hilbert_bits - 4;
  std::map<std::uint64_t, std::array<int, 2>> squares;
  for (std::uint32_t x = 0; x < n; ++x) {
    for (std::uint32_t y = 0; y < n; ++y)
      squares[hilbert_key(x << shift, y << shift) >> (2 * shift)] = {static_cast<int>(x),
                                                                     static_cast<int>(y)};
  }
  ASSERT_EQ(squares.size(), n * n);
  for (std::uint64_t key = 1; key < n * n; ++key) {
    const auto &a = squares.at(key - 1), &b = squares.at(key);
    EXPECT_EQ(std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]), 1);
  }
}

TEST(Parts, AreTheSameOnAnyNumberOfRanks) {
  const Mesh whole = grid();
  const Field field = field_of(whole);
  const MeshOrder order = own_order(whole);
  const Mesh own = scatter_mesh(world(), whole, order);
  const Field own_field = scatter_field(world(), field, own, order);
  for (const std::int32_t parts : {1, 2, 7, 64}) {
    const std::vector<MeshPart> expected = all_parts(whole, parts, &field);
    const std::vector<MeshPart> made = make_parts(world(), own, partition(world(), own, parts), &own_field);
    EXPECT_EQ(world().sum(std::ssize(made)), parts);
    for (const MeshPart& part : made) expect_equal(part, expected.at(part.number));
    const Communicator alone(MPI_COMM_SELF);
    const PartStatistics statistics = part_statistics(world(), made),
                         of_all = part_statistics(alone, expected);
    EXPECT_EQ(statistics.edge_cut, of_all.edge_cut);
    EXPECT_EQ(statistics.balance, of_all.balance);
    EXPECT_EQ(statistics.shared_nodes, of_all.shared_nodes);
    EXPECT_EQ(statistics.most_neighbours, of_all.most_neighbours);
  }
}

TEST(Parts, AreValidMeshesAndMakeUpTheWhole) {
  const Mesh whole = grid();
  const Field field = field_of(whole);
  for (const std::int32_t parts : {1, 2, 7, 64}) {
    const std::vector<MeshPart> made = all_parts(whole, parts, &field);
    for (const MeshPart& part : made) {
      EXPECT_TRUE(validate(without_empty_boundaries(part.mesh)).empty()) << part.number << " of " << parts;
      EXPECT_FALSE(part.mesh.triangles.empty() && part.mesh.quads.empty());
    }
    const JoinedMesh again = joined(whole, made);
    EXPECT_EQ(again.mesh.points, whole.points);
    EXPECT_EQ(again.mesh.triangles, whole.triangles);
    EXPECT_EQ(again.mesh.quads, whole.quads);
    for (std::size_t b = 0; b < whole.boundaries.size(); ++b)
      EXPECT_EQ(again.mesh.boundaries[b].edges, whole.boundaries[b].edges);
    ASSERT_TRUE(again.field);
    EXPECT_EQ(again.field->values, field.values);
    EXPECT_EQ(again.field->constants, field.constants);
    EXPECT_EQ(again.field->cells.names, field.cells.names);
    EXPECT_EQ(again.field->cells.values, field.cells.values);
  }
}

TEST(Parts, AgreeWithTheirNeighbours) {
  const std::vector<MeshPart> parts = all_parts(grid(), 7);
  std::size_t all_shared = 0;
  for (const MeshPart& a : parts) {
    for (const MeshPart& b : parts) {
      if (a.number == b.number) continue;
      const auto shared = numbers_shared(a, b.number);
      all_shared += shared.size();
      EXPECT_EQ(shared, numbers_shared(b, a.number));
      EXPECT_TRUE(std::ranges::is_sorted(shared));
      std::vector<std::int64_t> common;
      std::ranges::set_intersection(a.nodes, b.nodes, std::back_inserter(common));
      EXPECT_EQ(shared, common);
      EXPECT_EQ(edges_to(a, part_name(b.number), false), edges_to(b, part_name(a.number), true));
    }
    for (std::size_t i = 0; i < a.nodes.size(); ++i) {
      const auto lowest = std::ranges::find_if(
          parts, [&](const MeshPart& part) { return std::ranges::binary_search(part.nodes, a.nodes[i]); });
      EXPECT_EQ(a.owners[i], lowest->number);
    }
  }
  EXPECT_GT(all_shared, 0U);
}

TEST(Parts, WeighTheSameAndAreCompact) {
  const Mesh whole = test::Grid{.n = 64}.mesh();
  const Communicator alone(MPI_COMM_SELF);
  const PartStatistics statistics = part_statistics(alone, all_parts(whole, 16));
  EXPECT_EQ(statistics.parts, 16);
  EXPECT_LE(statistics.balance, 1.03);
  // Squares of 16 x 16 would cut 6 lines of 64 edges; parts that may differ a little have a few less.
  EXPECT_GE(statistics.edge_cut, 0.97 * 6 * 64);
  EXPECT_LE(statistics.edge_cut, 1.15 * 6 * 64);
  EXPECT_LE(statistics.most_neighbours, 10);
}

TEST(Parts, StayWithinThreePercentOfTheMean) {
  const Mesh whole = test::Grid{.n = 40, .size = {5, 1}}.mesh();
  for (const std::int32_t parts : {2, 3, 5, 12}) {
    std::int64_t all = 0, heaviest = 0, lightest = std::numeric_limits<std::int64_t>::max();
    for (const MeshPart& part : all_parts(whole, parts)) {
      const std::int64_t weight = 3 * std::ssize(part.triangles) + 4 * std::ssize(part.quads);
      all += weight;
      heaviest = std::max(heaviest, weight);
      lightest = std::min(lightest, weight);
    }
    EXPECT_LE(100 * parts * heaviest, 103 * all) << parts;
    EXPECT_GE(100 * parts * lightest, 97 * all) << parts;
  }
}

TEST(RefineSides, FindsTheNarrowPlace) {
  // Two squares of 6 x 6 nodes, one edge between them, each node at first on the side of its row.
  constexpr std::int32_t n = 6;
  WeightedGraph graph;
  const auto at = [](std::int32_t x, std::int32_t y) { return y * 2 * n + x; };
  for (std::int32_t y = 0; y < n; ++y) {
    for (std::int32_t x = 0; x < 2 * n; ++x) {
      graph.weights.push_back(1);
      graph.sides.push_back(y < n / 2 ? 0 : 1);
      graph.fixed.push_back({0, 0});
      graph.starts.push_back(std::ssize(graph.neighbours));
      const auto join = [&](std::int32_t dx, std::int32_t dy) {
        const std::int32_t to_x = x + dx, to_y = y + dy;
        if (to_x < 0 || to_x >= 2 * n || to_y < 0 || to_y >= n) return;
        const bool across = x / n != to_x / n;
        if (!across || y == 2) graph.neighbours.push_back({at(to_x, to_y), 1});
      };
      join(1, 0);
      join(-1, 0);
      join(0, 1);
      join(0, -1);
    }
  }
  graph.starts.push_back(std::ssize(graph.neighbours));
  SideWeights weights{{36, 36}, 34, 38};
  refine_sides(graph, weights);
  EXPECT_EQ(weights.sides, (std::array<std::int64_t, 2>{36, 36}));
  for (std::int32_t y = 0; y < n; ++y) {
    for (std::int32_t x = 0; x < 2 * n; ++x)
      EXPECT_EQ(graph.sides[at(x, y)], graph.sides[at(x < n ? 0 : n, 0)]);
  }
}

TEST(RefineSides, HeedsWhatStaysAndTheBounds) {
  // A chain whose nodes are drawn to side 1; three of them may go.
  WeightedGraph graph;
  for (std::int32_t i = 0; i < 6; ++i) {
    graph.weights.push_back(2);
    graph.sides.push_back(0);
    graph.fixed.push_back({0, i == 5 ? 3 : 1});
    graph.starts.push_back(std::ssize(graph.neighbours));
    if (i > 0) graph.neighbours.push_back({i - 1, 1});
    if (i < 5) graph.neighbours.push_back({i + 1, 1});
  }
  graph.starts.push_back(std::ssize(graph.neighbours));
  for (const auto& [least, most] : {std::pair{6, 30}, {0, 18}}) {
    WeightedGraph moved = graph;
    SideWeights weights{{12, 12}, least, most};
    refine_sides(moved, weights);
    EXPECT_EQ(weights.sides, (std::array<std::int64_t, 2>{6, 18}));
    EXPECT_EQ(moved.sides, (std::vector<char>{0, 0, 0, 1, 1, 1}));
  }
}

TEST(Parts, AnEdgeBetweenBlocksStaysWithTheCellToItsLeft) {
  Mesh whole = test::Grid{.n = 8}.mesh();
  BoundaryEdges between{"between", "interface", {}, {}};
  for (std::int32_t i = 0; i < 8; ++i) between.edges.push_back({NodeId{4 * 9 + i}, NodeId{4 * 9 + i + 1}});
  whole.boundaries.push_back(between);
  const MeshOrder order = own_order(whole);
  const Mesh own = scatter_mesh(world(), whole, order);
  for (const std::int32_t parts : {1, 5}) {
    const std::vector<MeshPart> expected = all_parts(whole, parts);
    for (const MeshPart& part : make_parts(world(), own, partition(world(), own, parts)))
      expect_equal(part, expected.at(part.number));
    EXPECT_EQ(joined(whole, expected).mesh.boundaries.back().edges, between.edges);
  }
}

/// The cells of a mesh in three blocks, which lie in turns along its order; sorted by block as in a file.
struct MixedBlocks {
  Mesh whole;   ///< block by block
  Mesh own;     ///< a rank's share of the mesh in its own order
  Field field;  ///< of the whole mesh
  Field own_field;

  explicit MixedBlocks(Mesh mesh) {
    const auto mixed = [](std::size_t cells) {
      std::vector<std::int32_t> blocks;
      for (std::size_t i = 0; i < cells; ++i) blocks.push_back(static_cast<std::int32_t>(i / 5 % 3));
      return blocks;
    };
    mesh.blocks = {{"gas", "solid", "skin"}, mixed(mesh.triangles.size()), mixed(mesh.quads.size())};
    whole = mesh;
    field = field_of(mesh);
    const Field in_order = field;
    std::size_t first = 0, row = 0;
    const auto sort_kind = [&](const auto& cells, const std::vector<std::int32_t>& blocks, auto& sorted,
                               std::vector<std::int32_t>& sorted_blocks) {
      sorted.clear();
      sorted_blocks.clear();
      for (std::int32_t block = 0; block < 3; ++block) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
          if (blocks[i] != block) continue;
          sorted.push_back(cells[i]);
          sorted_blocks.push_back(block);
          for (const std::size_t k : {0, 1})
            field.cells.values[2 * row + k] = in_order.cells.values[2 * (first + i) + k];
          ++row;
        }
      }
      first += cells.size();
    };
    sort_kind(mesh.triangles, mesh.blocks.of_triangles, whole.triangles, whole.blocks.of_triangles);
    sort_kind(mesh.quads, mesh.blocks.of_quads, whole.quads, whole.blocks.of_quads);
    const MeshOrder order = own_order(mesh);
    own = scatter_mesh(world(), mesh, order);
    own_field = scatter_field(world(), in_order, own, order);
    own.blocks = {
        mesh.blocks.names,
        scatter_ordered(world(), std::span<const std::int32_t>(mesh.blocks.of_triangles), order.triangles),
        scatter_ordered(world(), std::span<const std::int32_t>(mesh.blocks.of_quads), order.quads)};
  }
};

TEST(Parts, NumberCellsBlockByBlock) {
  const MixedBlocks mesh(grid());
  const std::vector<MeshPart> made =
      make_parts(world(), mesh.own, partition(world(), mesh.own, 4), &mesh.own_field);
  for (const MeshPart& part : made) {
    EXPECT_EQ(part.mesh.blocks.names, mesh.whole.blocks.names);
    EXPECT_TRUE(std::ranges::is_sorted(part.triangles));
    EXPECT_TRUE(std::ranges::is_sorted(part.quads));
    for (std::size_t i = 0; i < part.triangles.size(); ++i) {
      EXPECT_EQ(part.mesh.blocks.of_triangles[i], mesh.whole.blocks.of_triangles[part.triangles[i]]);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_EQ(part.nodes[part.mesh.triangles[i][k].value()],
                  mesh.whole.triangles[part.triangles[i]][k].value());
      EXPECT_EQ(part.field->cells.values[2 * i], mesh.field.cells.values[2 * part.triangles[i]]);
    }
    const std::size_t triangles = part.triangles.size(), all = mesh.whole.triangles.size();
    for (std::size_t i = 0; i < part.quads.size(); ++i) {
      EXPECT_EQ(part.mesh.blocks.of_quads[i], mesh.whole.blocks.of_quads[part.quads[i]]);
      EXPECT_EQ(part.nodes[part.mesh.quads[i][0].value()], mesh.whole.quads[part.quads[i]][0].value());
      EXPECT_EQ(part.field->cells.values[2 * (triangles + i)],
                mesh.field.cells.values[2 * (all + part.quads[i])]);
    }
  }
}

TEST(Parts, HaveTheEdgesOfAnInnerLineWithBothCells) {
  constexpr std::int32_t n = 8;
  Mesh whole = test::Grid{.n = n}.mesh();
  BoundaryEdges line{"section", {}, {}, {}, false, true};
  for (std::int32_t i = 1; i < n - 1; ++i)
    line.edges.push_back({NodeId{4 * (n + 1) + i}, NodeId{4 * (n + 1) + i + 1}});
  whole.boundaries.insert(whole.boundaries.begin() + 1, line);
  const Mesh own = scatter_mesh(world(), whole, own_order(whole));
  for (const std::int32_t parts : {1, 2, 5}) {
    const std::vector<MeshPart> expected = all_parts(whole, parts);
    for (const MeshPart& part : make_parts(world(), own, partition(world(), own, parts)))
      expect_equal(part, expected.at(part.number));
    std::size_t inside = 0, cut = 0;
    for (const MeshPart& part : expected) {
      EXPECT_TRUE(validate(without_empty_boundaries(part.mesh)).empty()) << part.number << " of " << parts;
      EXPECT_EQ(part.edges.size(), whole.boundaries.size() - 1);
      inside += edges_to(part, "section", false).size();
      for (const MeshPart& other : expected) {
        const auto forth = edges_to(part, part_name(other.number), false);
        EXPECT_EQ(forth, edges_to(other, part_name(part.number), true));
        cut += std::ranges::count_if(forth, [&](const std::array<std::int64_t, 2>& edge) {
          return std::ranges::count(line.edges, std::array{NodeId{static_cast<std::int32_t>(edge[0])},
                                                           NodeId{static_cast<std::int32_t>(edge[1])}}) > 0;
        });
      }
    }
    EXPECT_EQ(inside + cut, line.edges.size()) << parts;
    EXPECT_GT(inside, 0U) << parts;
  }
}

TEST(PartNames, AreTakenForNoOthers) {
  for (const std::int32_t part : {0, 8, 12345}) EXPECT_TRUE(is_part_name(part_name(part)));
  for (const char* const name : {"", "part_", "part_1a", "part", "apart_0001", "part_-001"})
    EXPECT_FALSE(is_part_name(name)) << name;
}

TEST(StripsInPart, AreRunsOfWholeColumns) {
  StripLayers wake{"wake", {1, 0.5}, true, 3, {}};
  for (std::int64_t node = 0; node < 21; ++node) wake.nodes.emplace_back(30 - node);  // 7 columns, downwards
  const std::vector<std::int64_t> nodes{11, 13, 14, 15, 16, 17, 18, 19, 20, 21,
                                        23, 24, 25, 26, 27, 28, 29, 30, 40};
  const std::vector<StripLayers> found = strips_in_part({wake}, nodes);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "wake");
  EXPECT_EQ(found[0].layers, wake.layers);
  EXPECT_TRUE(found[0].from_wall);
  EXPECT_FALSE(found[1].from_wall);
  const auto whole_numbers = [&](const StripLayers& strip) {
    std::vector<std::int64_t> numbers;
    for (const GlobalNodeId node : strip.nodes) numbers.push_back(nodes[node.value()]);
    return numbers;
  };
  EXPECT_EQ(whole_numbers(found[0]), (std::vector<std::int64_t>{30, 29, 28, 27, 26, 25}));
  EXPECT_EQ(whole_numbers(found[1]), (std::vector<std::int64_t>{21, 20, 19, 18, 17, 16, 15, 14, 13}));
  EXPECT_TRUE(strips_in_part({wake}, std::vector<std::int64_t>{28, 29, 30}).empty()) << "one column";
}

TEST(Parts, OneForEachCellIsTheMost) {
  const Mesh whole = test::mixed_square();  // two quads, four triangles
  for (const MeshPart& part : all_parts(whole, 6))
    EXPECT_EQ(part.mesh.triangles.size() + part.mesh.quads.size(), 1U);
  EXPECT_THROW(all_parts(whole, 7), InputError);
}

TEST(Parts, RefuseWhatIsNoWholeMesh) {
  Mesh lonely = test::mixed_square();
  lonely.points.push_back({5, 5});
  ++lonely.owned_nodes;
  EXPECT_THROW(all_parts(lonely, 2), InputError);
  Mesh turned = test::mixed_square();
  std::swap(turned.boundaries[0].edges[0][0], turned.boundaries[0].edges[0][1]);
  EXPECT_THROW(all_parts(turned, 2), InputError);
  Mesh named = test::mixed_square();
  named.boundaries[0].name = "part_0001";
  EXPECT_THROW(all_parts(named, 2), InputError);
}

TEST(JoinParts, RefusesWhatDoesNotFit) {
  const Mesh whole = test::mixed_square();
  const auto refused = [&](const auto& change) {
    std::vector<MeshPart> parts = all_parts(whole, 2);
    change(parts);
    EXPECT_THROW(joined(whole, parts), InputError);
  };
  refused([](auto& parts) { parts.pop_back(); });
  refused([](auto& parts) { parts.push_back(parts[0]); });
  refused([](auto& parts) { parts[0].nodes.back() = 9; });
  refused([](auto& parts) { parts[1].nodes[0] = -1; });
  refused([](auto& parts) { parts[1].nodes.pop_back(); });
  refused([](auto& parts) {
    parts[1].mesh.points[0].x += 1e-9;
    parts[1].mesh.points.back().x += 1e-9;
  });
  refused([](auto& parts) { parts[1].owners.assign(parts[1].owners.size(), 0); });
  refused([](auto& parts) {
    parts[1].field = Field{{"v"}, std::vector<double>(parts[1].nodes.size(), 0), {}};
  });
}

}  // namespace
}  // namespace quadloop
