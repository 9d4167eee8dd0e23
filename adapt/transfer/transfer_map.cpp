#include "adapt/transfer/transfer_map.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "adapt/transfer/column_places.hpp"
#include "adapt/transfer/linear_rows.hpp"
#include "adapt/transfer/locate/cell_triangles.hpp"
#include "adapt/transfer/transfer_by.hpp"
#include "mesher/base/parallel/exchange.hpp"
#include "mesher/base/parallel/partners.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop::adapt {

namespace {

constexpr std::size_t most = TransferMap::most, stencil_width = 2 * most;

/// A row is a stencil: numbers of nodes, -1 for none, then their weights. Those of nodes are the nodes
/// themselves.
void combine_stencils(std::span<const std::span<const double>> rows, std::span<const double> weights,
                      std::span<double> result) {
  std::fill_n(result.begin(), most, -1.0);
  std::fill_n(result.begin() + most, most, 0.0);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    result[k] = rows[k][0];
    result[most + k] = weights[k];
  }
}

/// The stencils of the owned nodes themselves. Numbers below 2^53 are exact.
Field stencils_of(const Mesh& mesh) {
  Field field{std::vector<std::string>(stencil_width), {}, {}};
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const auto number = static_cast<double>(mesh.global(NodeId{node}).value());
    field.values.insert(field.values.end(), {number, -1, -1, 1, 0, 0});
  }
  return field;
}

Field stencils_between(const Communicator& comm, const Mesh& old_mesh, const Mesh& new_mesh) {
  const auto in_block = [&](const Mesh& old_part, const Field& of_part, const Mesh& new_part) {
    const Field field = with_ghosts(comm, old_part, of_part);
    const CurvePartition shares(comm, owned_points(old_part), owned_points(new_part));
    const BafflePlaces baffles(comm, old_part, new_part);
    const LinearSource old{old_part, field, centre_of_nodes(comm, old_part), shares, baffles};
    const std::vector<Point> places = column_places(comm, old_part, new_part);
    LinearRows rows = linear_rows(comm, old, new_part, places, combine_stencils);
    return Transferred{{field.names, std::move(rows.values), {}}, {}};
  };
  return transfer_by_block(comm, old_mesh, stencils_of(old_mesh), new_mesh, in_block).field;
}

using CellKey = PairKey<5>;
enum Side : std::uint64_t { of_old, of_new };

/// A cell by its nodes, whose numbers are those of the old mesh. Its partner is the same cell of the other
/// mesh.
template <std::size_t corners>
CellKey cell_key(Side side, std::array<std::int64_t, corners> nodes) {
  std::ranges::sort(nodes);
  CellKey key{};
  key.own[0] = side;
  key.partner[0] = side == of_old ? of_new : of_old;
  for (std::size_t k = 0; k < 4; ++k)
    key.own[k + 1] = key.partner[k + 1] = static_cast<std::uint64_t>(k < corners ? nodes[k] : -1);
  return key;
}

/// Calls `visit(nodes)` for triangles, then quads, with the numbers of their nodes.
template <class NumberOf, class Visit>
void for_each_cell(const Mesh& mesh, const NumberOf& number_of, const Visit& visit) {
  const auto numbered = [&](const auto& cell) {
    std::array<std::int64_t, std::tuple_size_v<std::decay_t<decltype(cell)>>> numbers{};
    std::ranges::transform(cell, numbers.begin(), number_of);
    visit(numbers);
  };
  std::ranges::for_each(mesh.triangles, numbered);
  std::ranges::for_each(mesh.quads, numbered);
}

/// The global numbers of a rank's cells.
struct CellRange {
  std::int64_t triangles, first_triangle, first_quad;

  std::int64_t number(std::int64_t local) const {
    return local < triangles ? first_triangle + local : first_quad + local - triangles;
  }
};

std::vector<CellRange> cell_ranges(const Communicator& comm, const Mesh& mesh) {
  const CellOwners cells(comm, mesh);
  const std::int64_t triangles = std::ssize(mesh.triangles);
  return comm.all_gather(CellRange{triangles, cells.number(0), cells.number(triangles)});
}

}  // namespace

TransferMap::TransferMap(const Communicator& comm, const Mesh& old_mesh, const Mesh& new_mesh)
    : comm_{comm}, owners_(comm, old_mesh.first_node) {
  const Field stencils = stencils_between(comm, old_mesh, new_mesh);
  for (std::int32_t node = 0; node < new_mesh.owned_nodes; ++node) {
    const auto row = stencils.row(NodeId{node});
    Nodes& nodes = nodes_.emplace_back();
    for (std::size_t k = 0; k < most; ++k) nodes[k] = GlobalNodeId{static_cast<std::int64_t>(row[k])};
    std::copy_n(row.begin() + most, most, weights_.emplace_back().begin());
  }
  find_same_nodes(old_mesh, new_mesh);
  find_same_cells(comm, old_mesh, new_mesh);
}

void TransferMap::find_same_nodes(const Mesh& old_mesh, const Mesh& new_mesh) {
  std::vector<double> positions;
  for (const Point p : owned_points(old_mesh)) positions.insert(positions.end(), {p.x, p.y});
  const std::vector<double> at = rows(positions, 2);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const Point first{at[2 * most * i], at[2 * most * i + 1]};
    const bool is_same =
        !nodes_[i][1].valid() && first == new_mesh.point(NodeId{static_cast<std::int32_t>(i)});
    same_.push_back(is_same ? nodes_[i][0] : GlobalNodeId{});
  }
}

void TransferMap::find_same_cells(const Communicator& comm, const Mesh& old_mesh, const Mesh& new_mesh) {
  std::vector<CellKey> keys;
  for_each_cell(
      old_mesh, [&](NodeId node) { return old_mesh.global(node).value(); },
      [&](const auto& nodes) { keys.push_back(cell_key(of_old, nodes)); });
  std::vector<GlobalNodeId> same = same_;
  same.resize(new_mesh.points.size());
  NodeExchange(comm, NodeOwners(comm, new_mesh.first_node), new_mesh.owned_nodes, new_mesh.ghosts)
      .update(same);
  std::vector<std::int64_t> asking;  // cells without new nodes
  const std::size_t of_old_mesh = keys.size();
  for_each_cell(
      new_mesh, [&](NodeId node) { return same[static_cast<std::size_t>(node.value())].value(); },
      [&](const auto& nodes) {
        if (std::ranges::min(nodes) >= 0) {
          asking.push_back(std::ssize(same_cells_));
          keys.push_back(cell_key(of_new, nodes));
        }
        same_cells_.push_back(-1);
      });
  const std::vector<CellRange> ranges = cell_ranges(comm, old_mesh);
  const std::vector<Partner> partners = find_partners(comm, std::span<const CellKey>(keys));
  for (std::size_t i = 0; i < asking.size(); ++i) {
    const Partner& old_cell = partners[of_old_mesh + i];
    if (old_cell.found()) same_cells_[asking[i]] = ranges[old_cell.rank].number(old_cell.item);
  }
}

std::vector<double> TransferMap::rows(const std::vector<double>& values, std::size_t width) const {
  std::vector<GlobalNodeId> asked;
  std::vector<std::size_t> asking;
  std::vector<int> ranks;
  for (std::size_t i = 0; i < most * nodes_.size(); ++i) {
    const GlobalNodeId node = nodes_[i / most][i % most];
    if (!node.valid()) continue;
    asked.push_back(node);
    asking.push_back(i);
    ranks.push_back(owners_.rank_of(node));
  }
  const Exchange questions(comm_, ranks);
  std::vector<double> answers;
  for (const GlobalNodeId node : questions.deliver(asked)) {
    const auto row = values.begin() + static_cast<std::ptrdiff_t>(owners_.local(node).value() * width);
    answers.insert(answers.end(), row, row + static_cast<std::ptrdiff_t>(width));
  }
  answers = questions.answer(answers, width);
  std::vector<double> all(most * nodes_.size() * width);
  for (std::size_t i = 0; i < asking.size(); ++i)
    std::copy_n(answers.begin() + static_cast<std::ptrdiff_t>(i * width), width,
                all.begin() + static_cast<std::ptrdiff_t>(asking[i] * width));
  return all;
}

std::vector<double> TransferMap::interpolate(const std::vector<double>& values, std::size_t width) const {
  const std::vector<double> at_nodes = rows(values, width);
  std::vector<double> sums(nodes_.size() * width);
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    for (std::size_t k = 0; k < most; ++k) {
      for (std::size_t n = 0; n < width; ++n)
        sums[i * width + n] += weights_[i][k] * at_nodes[(most * i + k) * width + n];
    }
  }
  return sums;
}

}  // namespace quadloop::adapt
