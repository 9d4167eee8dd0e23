#include "adapt/sensor/indicator.hpp"

#include <algorithm>
#include <cmath>

#include "adapt/sensor/cell_jumps.hpp"
#include "adapt/sensor/cells_of_leaves.hpp"
#include "adapt/sensor/recovery/node_gradients.hpp"
#include "mesher/mesh/cells/block_part.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop::adapt {

namespace {

template <class T>
T change(std::span<const T> of_nodes, NodeId from, NodeId to) {
  return of_nodes[to.value()] - of_nodes[from.value()];
}

/// Raises each cell's value to the largest indicator of its relevant edges. `of_edge(from, to)` must have the
/// same bits as `of_edge(to, from)`, as cells and ranks see an edge in different directions. Absolute values
/// of a change, and products of two changes, satisfy this.
template <class OfEdge>
void raise_by_edges(const Mesh& mesh, const TellingEdges& edges, const OfEdge& of_edge,
                    std::vector<double>& of_cells) {
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    if (!edges.tells(from, to)) return;
    double& value = of_cells[cell];
    value = std::max(value, of_edge(from, to));
  });
}

void raise_by_field(const Communicator& comm, const Mesh& mesh, const TellingEdges& edges,
                    const ScaledField& field, Indicator kind, std::vector<double>& of_cells) {
  const std::span<const double> values(field.values);
  const std::span<const Point> points(mesh.points);
  const auto unless_rounding = [&](double difference) {
    return difference > field.rounding ? difference : 0;
  };
  const auto difference = [&](NodeId from, NodeId to) {
    return unless_rounding(std::abs(change(values, from, to)));
  };
  switch (kind) {
    case Indicator::difference: raise_by_edges(mesh, edges, difference, of_cells); break;
    case Indicator::gradient: {
      const auto slope = [&](NodeId from, NodeId to) {
        return difference(from, to) / length(change(points, from, to));
      };
      raise_by_edges(mesh, edges, slope, of_cells);
      break;
    }
    case Indicator::hessian: {
      const std::vector<Point> of_nodes = node_gradients(comm, mesh, values);
      const std::span<const Point> gradients(of_nodes);
      const auto bend = [&](NodeId from, NodeId to) {
        return unless_rounding(std::abs(dot(change(gradients, from, to), change(points, from, to))));
      };
      raise_by_edges(mesh, edges, bend, of_cells);
      break;
    }
  }
}

/// Returns the largest indicator of each cell's edges. *Collective.*
std::vector<double> cell_indicator(const Communicator& comm, const Mesh& mesh, const Field& field,
                                   Indicator kind) {
  std::vector<double> of_cells(mesh.cell_count(), 0);
  const Field shared = with_ghosts(comm, mesh, field);
  const TellingEdges edges(comm, mesh);
  for (std::size_t variable = 0; variable < shared.width(); ++variable) {
    const ScaledField scaled = scaled_by_range(comm, shared.column(variable));
    if (!scaled.constant) raise_by_field(comm, mesh, edges, scaled, kind, of_cells);
  }
  if (field.cells.width() > 0) {
    const CellJumps jumps(comm, mesh, edges, kind);
    for (std::size_t variable = 0; variable < field.cells.width(); ++variable) {
      const ScaledField scaled = scaled_by_range(comm, field.cells.column(variable));
      if (!scaled.constant) jumps.raise(scaled, of_cells);
    }
  }
  return of_cells;
}

}  // namespace

std::vector<double> leaf_indicator(const Communicator& comm, const Mesh& mesh,
                                   std::span<const LeafRecord> leaves, const Field& field, Indicator kind) {
  const CellsOfLeaves cells_of_leaves(comm, mesh, leaves);
  check_field(comm, mesh, field, FieldSign::any);
  const std::vector<double> of_cells = cells_by_block<double>(
      comm, mesh, field,
      [&](const Mesh& part, const Field& of_part) { return cell_indicator(comm, part, of_part, kind); });
  return cells_of_leaves.largest(comm, of_cells);
}

std::vector<double> leaf_errors(const Communicator& comm, const Mesh& mesh,
                                std::span<const LeafRecord> leaves, const Field& error) {
  const CellsOfLeaves cells_of_leaves(comm, mesh, leaves);
  check_field(comm, mesh, error, FieldSign::not_negative);
  if (error.cells.width() > 0) return cells_of_leaves.largest(comm, error.cells.column(0));
  const std::vector<double> values = with_ghosts(comm, mesh, error).column(0);
  std::vector<double> of_cells(mesh.cell_count(), 0);
  for_each_cell_edge(mesh, [&](NodeId from, NodeId, std::int32_t cell) {
    double& value = of_cells[cell];
    value = std::max(value, values[from.value()]);
  });
  return cells_of_leaves.largest(comm, of_cells);
}

}  // namespace quadloop::adapt
