#include "adapt/transfer/transfer_map.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "adapt/transfer/column_places.hpp"
#include "adapt/transfer/equal_cells.hpp"
#include "adapt/transfer/linear_rows.hpp"
#include "adapt/transfer/locate/cell_triangles.hpp"
#include "adapt/transfer/transfer_by.hpp"
#include "mesher/base/parallel/exchange.hpp"
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
  const CellOwners owners(comm, old_mesh);
  const EqualCells equal = find_equal_cells(comm, old_mesh, new_mesh, new_mesh.points);
  auto number = equal.numbers.begin();
  for (const std::int32_t old : equal.old_cell) {
    if (old == EqualCells::elsewhere)
      same_cells_.push_back(*number++);
    else
      same_cells_.push_back(old == EqualCells::none ? -1 : owners.number(old));
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
