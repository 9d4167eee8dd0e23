// The map of a transfer: the transfer's own values, the same on any ranks, and what two meshes have in
// common.
#include "adapt/transfer/transfer_map.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "adapt/transfer/transfer_by.hpp"
#include "mesher/base/error.hpp"
#include "tests/adapt/transfer/gathered.hpp"
#include "tests/adapt/transfer/jittered_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/two_blocks.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::gathered;
using test::jittered;
using test::scattered;
using test::WholeMesh;
using test::world;

Field scattered_field(const Mesh& mesh) {
  Field field{{"a", "b"}, {}, {}};
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    for (int k = 0; k < 2; ++k) field.values.push_back(scattered(5, mesh.first_node + node, k));
  }
  return field;
}

/// Interpolates by the map; the largest difference from the transfer.
double difference_from_transfer(const Mesh& old_mesh, const Mesh& new_mesh) {
  const Field field = scattered_field(old_mesh);
  const std::vector<double> by_transfer = transfer(world(), old_mesh, field, new_mesh).field.values,
                            by_map = TransferMap(world(), old_mesh, new_mesh).interpolate(field.values, 2);
  EXPECT_EQ(by_map.size(), by_transfer.size());
  double largest = 0;
  for (std::size_t i = 0; i < by_map.size(); ++i)
    largest = std::max(largest, std::abs(by_map[i] - by_transfer[i]));
  return largest;
}

TEST(TransferMap, InterpolatesAsTheTransferDoes) {
  for (const bool quads : {true, false}) {
    const Mesh old_mesh = jittered({13, {1, 1}, quads}, 0.2, 3).part(world());
    WholeMesh after = jittered({17, {1, 1}, quads}, 0.2, 4);
    EXPECT_LT(difference_from_transfer(old_mesh, after.part(world())), 1e-14);
    for (Point& p : after.mesh.points) p = p + Point{0.3, 0.1};  // partly outside
    EXPECT_LT(difference_from_transfer(old_mesh, after.part(world())), 1e-14);
  }
}

TEST(TransferMap, NoValueCrossesAnInterface) {
  const Mesh old_whole = test::two_blocks({8}), new_whole = test::two_blocks({14});
  const Mesh old_mesh = test::part_with_blocks(world(), old_whole, test::shuffled_order(old_whole, 1)),
             new_mesh = test::part_with_blocks(world(), new_whole, test::shuffled_order(new_whole, 2));
  EXPECT_LT(difference_from_transfer(old_mesh, new_mesh), 1e-14);
}

/// Nodes, weights and equal cells, as numbers.
std::vector<double> numbers_of(const TransferMap& map) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < map.nodes().size(); ++i) {
    for (std::size_t k = 0; k < TransferMap::most; ++k) {
      numbers.push_back(static_cast<double>(map.nodes()[i][k].value()));
      numbers.push_back(map.weights()[i][k]);
    }
    numbers.push_back(static_cast<double>(map.same()[i].value()));
  }
  return numbers;
}

TEST(TransferMap, IsTheSameOnAnyRanks) {
  const Communicator alone(MPI_COMM_SELF);
  const WholeMesh before = jittered({12}, 0.2, 3), after = jittered({9}, 0.2, 4);
  const TransferMap whole(alone, before.part(alone), after.part(alone)),
      parts(world(), before.part(world()), after.part(world()));
  EXPECT_EQ(gathered(numbers_of(parts)), numbers_of(whole));
  double sum = 0;
  for (const auto& weights : whole.weights()) sum += weights[0] + weights[1] + weights[2];
  EXPECT_NEAR(sum, 100, 1e-11);
}

/// Centroids of triangles, then of quads, of all ranks: by global number.
std::vector<double> centroids(const Mesh& mesh) {
  const auto of = [&](const auto& cells) {
    std::vector<double> sums;
    for (const auto& cell : cells) {
      Point sum{};
      for (const NodeId node : cell) sum = sum + mesh.point(node);
      sums.insert(sums.end(), {sum.x / size32(cell), sum.y / size32(cell)});
    }
    return gathered(sums);
  };
  std::vector<double> all = of(mesh.triangles);
  const std::vector<double> quads = of(mesh.quads);
  all.insert(all.end(), quads.begin(), quads.end());
  return all;
}

TEST(TransferMap, FindsWhatTheMeshesHaveInCommon) {
  const test::Grid grid{12};
  const WholeMesh before = jittered(grid, 0.2, 3);
  WholeMesh after{before.mesh, test::shuffled_order(before.mesh, 8)};
  after.mesh.points[5 * 13 + 6] = after.mesh.points[5 * 13 + 6] + Point{0.01, 0.002};
  const Mesh old_mesh = before.part(world()), new_mesh = after.part(world());
  const TransferMap map(world(), old_mesh, new_mesh);
  std::vector<double> own, new_own;
  for (std::int32_t i = 0; i < old_mesh.owned_nodes; ++i)
    own.insert(own.end(), {old_mesh.point(NodeId{i}).x, old_mesh.point(NodeId{i}).y});
  const std::vector<double> positions = gathered(own);
  std::int64_t new_nodes = 0;
  for (std::int32_t i = 0; i < new_mesh.owned_nodes; ++i) {
    const std::int64_t old_node = map.same()[static_cast<std::size_t>(i)].value();
    if (old_node < 0) {
      ++new_nodes;
      continue;
    }
    EXPECT_EQ(positions[static_cast<std::size_t>(2 * old_node)], new_mesh.point(NodeId{i}).x);
    EXPECT_EQ(positions[static_cast<std::size_t>(2 * old_node + 1)], new_mesh.point(NodeId{i}).y);
  }
  EXPECT_EQ(world().sum(new_nodes), 1);
  const std::vector<double> of_old = centroids(old_mesh);
  std::int64_t new_cells = 0, at_moved = 0;
  std::size_t cell = 0;
  const auto look = [&](const auto& nodes) {
    Point sum{};
    bool is_at_moved = false;
    for (const NodeId node : nodes) {
      sum = sum + new_mesh.point(node);
      is_at_moved |= new_mesh.point(node) == after.mesh.points[5 * 13 + 6];
    }
    at_moved += is_at_moved ? 1 : 0;
    const std::int64_t old_cell = map.same_cells()[cell++];
    if (old_cell < 0) ++new_cells;
    if (old_cell < 0) return;
    EXPECT_NEAR(of_old[static_cast<std::size_t>(2 * old_cell)], sum.x / size32(nodes), 1e-14);
    EXPECT_NEAR(of_old[static_cast<std::size_t>(2 * old_cell + 1)], sum.y / size32(nodes), 1e-14);
  };
  for (const auto& nodes : new_mesh.triangles) look(nodes);
  for (const auto& nodes : new_mesh.quads) look(nodes);
  EXPECT_EQ(cell, map.same_cells().size());
  EXPECT_EQ(world().sum(new_cells), world().sum(at_moved));
}

TEST(TransferBy, AFunctionTransfersAndItsDriftIsReported) {
  const Mesh old_mesh = jittered({12}, 0.2, 3).part(world()), new_mesh = jittered({9}, 0.2, 4).part(world());
  const Field field = scattered_field(old_mesh);
  const auto by_map = [](const Mesh& from, const Field& of_old, const Mesh& to) {
    return Field{of_old.names, TransferMap(world(), from, to).interpolate(of_old.values, 2), {}};
  };
  const Transferred own = transfer_by(world(), old_mesh, field, new_mesh, by_map),
                    usual = transfer(world(), old_mesh, field, new_mesh);
  ASSERT_EQ(own.report.drift.size(), 2U);
  EXPECT_NEAR(own.report.drift[0], usual.report.drift[0], 1e-14);
  EXPECT_NEAR(own.report.relative_drift[1], usual.report.relative_drift[1], 1e-14);
  const auto renames = [&](const Mesh& from, const Field& of_old, const Mesh& to) {
    Field result = by_map(from, of_old, to);
    result.names[0] = "c";
    return result;
  };
  EXPECT_THROW(transfer_by(world(), old_mesh, field, new_mesh, renames), InputError);
  const auto loses = [&](const Mesh& from, const Field& of_old, const Mesh& to) {
    Field result = by_map(from, of_old, to);
    if (world().is_root()) result.values.resize(1);
    return result;
  };
  EXPECT_THROW(transfer_by(world(), old_mesh, field, new_mesh, loses), InputError);
}

}  // namespace
}  // namespace quadloop::adapt
