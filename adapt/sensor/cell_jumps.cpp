#include "adapt/sensor/cell_jumps.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/base/error.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop::adapt {

namespace {

double unless_rounding(const ScaledField& field, double difference) {
  return difference > field.rounding ? difference : 0;
}

}  // namespace

CellJumps::CellJumps(const Communicator& comm, const Mesh& mesh, const TellingEdges& edges, Indicator kind)
    : comm_{comm}, mesh_{mesh}, edges_{edges}, kind_{kind}, round_nodes_(comm, mesh), owners_(comm, mesh) {
  const EdgeCells edge_cells_here = edge_cells(comm, mesh);
  auto across = edge_cells_here.across.begin();
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    const std::int64_t other = *across++;
    if (other == EdgeCells::none || !edges.tells_across(from, to)) return;
    across_.push_back(other);
    pairs_.push_back({cell, 0});
  });
  std::vector<Point> centroids;
  for (const CellShape& shape : round_nodes_.shapes()) centroids.push_back(shape.centroid);
  const std::vector<Point> others =
      rows_of_cells(comm, owners_, std::span<const std::int64_t>(across_), centroids);
  for (std::size_t i = 0; i < pairs_.size(); ++i)
    pairs_[i].distance = length(others[i] - centroids[pairs_[i].cell]);
}

void CellJumps::raise(const ScaledField& field, std::vector<double>& of_cells) const {
  switch (kind_) {
    case Indicator::difference:
    case Indicator::gradient: return raise_by_jumps(field, of_cells);
    case Indicator::hessian: return raise_by_bends(field, of_cells);
  }
  QUADLOOP_REQUIRE(false, "an indicator without values for cells");
}

void CellJumps::raise_by_jumps(const ScaledField& field, std::vector<double>& of_cells) const {
  const std::vector<double> others =
      rows_of_cells(comm_, owners_, std::span<const std::int64_t>(across_), field.values);
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const auto& [cell, distance] = pairs_[i];
    const double jump = unless_rounding(field, std::abs(others[i] - field.values[cell]));
    of_cells[cell] = std::max(of_cells[cell], kind_ == Indicator::gradient ? jump / distance : jump);
  }
}

void CellJumps::raise_by_bends(const ScaledField& field, std::vector<double>& of_cells) const {
  const std::vector<AroundNode> around = round_nodes_.of(field.values);
  for_each_cell_edge(mesh_, [&](NodeId from, NodeId to, std::int32_t cell) {
    const AroundNode &a = around[from.value()], &b = around[to.value()];
    if (!edges_.tells(from, to) || !a.has_gradient || !b.has_gradient) return;
    const double bend = std::abs(dot(b.gradient - a.gradient, mesh_.point(to) - mesh_.point(from)));
    of_cells[cell] = std::max(of_cells[cell], unless_rounding(field, bend));
  });
}

}  // namespace quadloop::adapt
