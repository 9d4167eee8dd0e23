#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "adapt/transfer/column_places.hpp"
#include "adapt/transfer/conservative.hpp"
#include "adapt/transfer/linear_rows.hpp"
#include "adapt/transfer/locate/baffle_places.hpp"
#include "adapt/transfer/locate/cell_triangles.hpp"
#include "adapt/transfer/locate/curve_partition.hpp"
#include "adapt/transfer/locate/nearest_boundary.hpp"
#include "adapt/transfer/mesh_integrals.hpp"
#include "adapt/transfer/transfer_by.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/exchange.hpp"
#include "mesher/base/parallel/shared_stage.hpp"
#include "mesher/mesh/cells/block_part.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop::adapt {

namespace {

/// Positions of owned nodes, followed by those of ghosts. *Collective.*
std::vector<Point> with_ghosts(const Communicator& comm, const Mesh& mesh, std::vector<Point> places) {
  places.resize(mesh.points.size());
  NodeExchange(comm, NodeOwners(comm, mesh.first_node), mesh.owned_nodes, mesh.ghosts).update(places);
  return places;
}

/// Cells outside the old mesh get the values of the cell at the nearest boundary edge. *Collective.*
void take_from_boundary_cells(const Communicator& comm, const Mesh& old_mesh, const CellValues& old_cells,
                              const Mesh& new_mesh, const BafflePlaces& baffles, TransferredCells& result) {
  const NearestBoundary boundary(comm, old_mesh);
  const std::vector<CellShape> shapes = cell_shapes(new_mesh);
  std::vector<std::int32_t> edges;
  std::vector<int> ranks;
  for (const std::int64_t cell : result.outside) {
    const Point centroid = shapes[cell].centroid;
    const BoundaryPlace place = baffles.across(centroid).value_or(boundary.nearest(centroid));
    edges.push_back(place.edge);
    ranks.push_back(place.rank);
  }
  const Exchange questions(comm, ranks);
  const std::vector<std::int64_t> of_boundary = edge_cells(comm, old_mesh).of_boundary;
  std::vector<std::int64_t> cells;
  for (const std::int32_t edge : questions.deliver(edges)) cells.push_back(of_boundary[edge]);
  cells = questions.answer(cells);
  const std::size_t width = old_cells.width();
  const std::vector<double> rows = rows_of_cells(
      comm, CellOwners(comm, old_mesh), std::span<const std::int64_t>(cells), old_cells.values, width);
  for (std::size_t i = 0; i < cells.size(); ++i)
    std::copy_n(rows.begin() + i * width, width, result.values.begin() + result.outside[i] * width);
}

/// *Collective.*
CellValues transferred_cells(const Communicator& comm, const MeshPair& meshes, const CellValues& old_cells,
                             TransferReport& report) {
  TransferredCells result = transfer_cells(comm, meshes, old_cells);
  report.cells_outside = comm.sum(std::ssize(result.outside));
  if (report.cells_outside > 0)
    take_from_boundary_cells(comm, meshes.old_mesh, old_cells, meshes.new_mesh, *meshes.baffles, result);
  return {old_cells.names, std::move(result.values)};
}

/// Integrals of each variable over the old mesh, nodal ones first, then those of cells.
NodalIntegrals integrals_of(const Communicator& comm, const Mesh& mesh, Point centre, const Field& field) {
  NodalIntegrals integrals = integrate_with_sizes(comm, mesh, centre, field);
  if (field.cells.width() == 0) return integrals;
  const CellIntegrals of_cells = integrate_cells(comm, mesh, field.cells);
  integrals.values.insert(integrals.values.end(), of_cells.values.begin(), of_cells.values.end());
  integrals.sizes.insert(integrals.sizes.end(), of_cells.sizes.begin(), of_cells.sizes.end());
  return integrals;
}

void report_drift(const Communicator& comm, const Mesh& new_mesh, const Field& field,
                  const NodalIntegrals& before, TransferReport& report) {
  std::vector<double> after =
      integrate(comm, new_mesh, centre_of_nodes(comm, new_mesh), with_ghosts(comm, new_mesh, field));
  if (field.cells.width() > 0) {
    const CellIntegrals of_cells = integrate_cells(comm, new_mesh, field.cells);
    after.insert(after.end(), of_cells.values.begin(), of_cells.values.end());
  }
  for (std::size_t k = 0; k < after.size(); ++k) {
    report.drift.push_back(after[k] - before.values[k]);
    report.relative_drift.push_back(before.sizes[k] > 0 ? report.drift[k] / before.sizes[k] : 0);
  }
}

/// *Collective.*
Transferred transfer_in_block(const Communicator& comm, const Mesh& old_mesh, const Field& old_field,
                              const Mesh& new_mesh, TransferKind kind) {
  const Field old = with_ghosts(comm, old_mesh, old_field);
  const Point centre = centre_of_nodes(comm, old_mesh);
  const CurvePartition shares(comm, owned_points(old_mesh), owned_points(new_mesh));
  const std::vector<Point> at = column_places(comm, old_mesh, new_mesh);
  Transferred transferred;
  TransferReport& report = transferred.report;
  const BafflePlaces baffles(comm, old_mesh, new_mesh);
  LinearRows rows = linear_rows(comm, {old_mesh, old, centre, shares, baffles}, new_mesh, at);
  report.outside = rows.outside;
  transferred.field = {old.names, std::move(rows.values), old.constants};
  const bool conserves = kind == TransferKind::conservative && old.width() > 0;
  if (conserves || old.cells.width() > 0) {
    const std::vector<Point> places = with_ghosts(comm, new_mesh, at);
    const Point new_centre = centre_of_nodes(comm, new_mesh);
    const MeshPair meshes{
        shares,     old_mesh,
        new_mesh,   centre,
        new_centre, places,
        &baffles,   find_equal_cells(comm, old_mesh, new_mesh, places, new_centre == centre)};
    if (conserves) conserve_at_nodes(comm, meshes, old, transferred.field.values);
    if (old.cells.width() > 0) transferred.field.cells = transferred_cells(comm, meshes, old.cells, report);
  }
  report_drift(comm, new_mesh, transferred.field, integrals_of(comm, old_mesh, centre, old), report);
  report.conserved_from = conserves ? 0 : old.width();
  if (report.conserved_from < report.drift.size())
    report.area_change = total_area(comm, new_mesh) / total_area(comm, old_mesh) - 1;
  return transferred;
}

/// Puts a block's rows into those of the mesh; a node on an interface keeps the row of the first block.
void put_rows(const BlockPart& part, const Field& of_part, NodeFlags& filled, Field& field) {
  for (std::int32_t i = 0; i < size32(part.nodes); ++i) {
    const NodeId node = part.nodes[i];
    if (std::exchange(filled[node], 1) == 0)
      std::ranges::copy(of_part.row(NodeId{i}), field.row(node).begin());
  }
  const std::size_t width = field.cells.width();
  for (std::size_t i = 0; i < part.cells.size(); ++i)
    std::copy_n(of_part.cells.values.begin() + i * width, width,
                field.cells.values.begin() + part.cells[i] * width);
}

double larger(double a, double b) { return std::abs(b) > std::abs(a) ? b : a; }

void add_report(const TransferReport& block, TransferReport& all) {
  all.outside += block.outside;
  all.cells_outside += block.cells_outside;
  all.conserved_from = block.conserved_from;
  all.area_change = larger(all.area_change, block.area_change);
  for (std::size_t k = 0; k < block.drift.size(); ++k) {
    all.drift[k] += block.drift[k];
    all.relative_drift[k] = larger(all.relative_drift[k], block.relative_drift[k]);
  }
}

}  // namespace

Transferred transfer_by_block(const Communicator& comm, const Mesh& old_mesh, const Field& old_field,
                              const Mesh& new_mesh, const TransferInBlock& in_block) {
  if (!has_blocks(old_mesh) && !has_blocks(new_mesh)) return in_block(old_mesh, old_field, new_mesh);
  comm.together([&] {
    if (old_mesh.blocks.names.size() != new_mesh.blocks.names.size())
      throw InputError(fmt::format("the old mesh has {} blocks, but the new one has {}; keep the blocks",
                                   old_mesh.blocks.names.size(), new_mesh.blocks.names.size()));
  });
  Transferred all{{old_field.names, {}, old_field.constants, {old_field.cells.names, {}}},
                  TransferReport::without_drift(old_field)};
  all.field.values.resize(new_mesh.owned_nodes * old_field.width());
  all.field.cells.values.resize(new_mesh.cell_count() * old_field.cells.width());
  NodeFlags filled(new_mesh.owned_nodes, 0);
  const std::vector<BlockPart> old_parts = block_parts(comm, old_mesh), parts = block_parts(comm, new_mesh);
  for (std::size_t b = 0; b < parts.size(); ++b) {
    const Transferred of_block =
        in_block(old_parts[b].mesh, field_on(old_parts[b], old_field), parts[b].mesh);
    put_rows(parts[b], of_block.field, filled, all.field);
    add_report(of_block.report, all.report);
  }
  return all;
}

Transferred transfer(const Communicator& comm, const Mesh& old_mesh, const Field& old_field,
                     const Mesh& new_mesh, TransferKind kind) {
  const progress::SharedStage stage(comm, "transfer");
  return transfer_by_block(comm, old_mesh, old_field, new_mesh,
                           [&](const Mesh& old_part, const Field& field, const Mesh& new_part) {
                             return transfer_in_block(comm, old_part, field, new_part, kind);
                           });
}

Transferred transfer_by(const Communicator& comm, const Mesh& old_mesh, const Field& old_field,
                        const Mesh& new_mesh, const TransferFunction& function) {
  const progress::SharedStage stage(comm, "transfer");
  Transferred transferred;
  transferred.field = function(old_mesh, old_field, new_mesh);
  const Field& field = transferred.field;
  comm.together([&] {
    if (field.names != old_field.names || field.cells.names != old_field.cells.names)
      throw InputError("the transferred solution has other variables than the old one");
    if (field.values.size() != field.width() * new_mesh.owned_nodes ||
        field.cells.values.size() != field.cells.width() * new_mesh.cell_count())
      throw InputError("the transferred solution does not have a row for each owned node and each cell");
  });
  transferred.field.constants = old_field.constants;
  report_drift(
      comm, new_mesh, field,
      integrals_of(comm, old_mesh, centre_of_nodes(comm, old_mesh), with_ghosts(comm, old_mesh, old_field)),
      transferred.report);
  transferred.report.conserved_from = transferred.report.drift.size();
  return transferred;
}

}  // namespace quadloop::adapt
