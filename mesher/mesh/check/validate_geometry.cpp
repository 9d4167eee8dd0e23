#include "mesher/mesh/check/validate_geometry.hpp"

#include <mpi.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/box_over_ranks.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/mesh/check/cell_reach.hpp"
#include "mesher/mesh/check/compare_outline.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

std::vector<double> longest_edge_of_cells(const Mesh& mesh) {
  std::vector<double> longest(mesh.cell_count(), 0);
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    auto& value = longest[cell];
    value = std::max(value, length(mesh.point(to) - mesh.point(from)));
  });
  return longest;
}

/// Returns the values of cells given by global number, that of no cell for none. *Collective.*
template <class T>
std::vector<T> values_of_cells(const Communicator& comm, const CellOwners& owners,
                               std::span<const std::int64_t> cells, const std::vector<T>& values, T of_none) {
  std::vector<std::int64_t> known;
  std::ranges::copy_if(cells, std::back_inserter(known), [](std::int64_t cell) { return cell >= 0; });
  const std::vector<T> found = rows_of_cells(comm, owners, known, values);
  std::vector<T> all;
  auto next = found.begin();
  for (const std::int64_t cell : cells) all.push_back(cell >= 0 ? *next++ : of_none);
  return all;
}

/// Returns the sides of all boundary edges on the root, boundary after boundary. *Collective.*
std::vector<EdgeSides> sides_of_boundaries(const Communicator& comm, const Mesh& mesh,
                                           const CellBlocks& blocks, const std::vector<double>& longest) {
  const CellOwners owners(comm, mesh);
  std::vector<std::int32_t> block(longest.size());
  for (std::size_t cell = 0; cell < block.size(); ++cell) block[cell] = blocks.of(cell);
  const std::vector<std::int64_t> left = cells_left_of_boundaries(comm, mesh),
                                  right = cells_right_of_boundaries(comm, mesh);
  const auto lefts = values_of_cells(comm, owners, left, block, EdgeSides::none),
             rights = values_of_cells(comm, owners, right, block, EdgeSides::none);
  const std::vector<double> longest_left = values_of_cells(comm, owners, left, longest, 0.0);
  std::vector<EdgeSides> own;
  for (std::int32_t b = 0; b < size32(mesh.boundaries); ++b) {
    for (std::size_t i = 0; i < mesh.boundaries[b].edges.size(); ++i) {
      const std::size_t edge = own.size();
      own.push_back({b, lefts[edge], rights[edge], longest_left[edge]});
    }
  }
  std::vector<EdgeSides> all = gather_at_root(comm, own);
  std::ranges::stable_sort(all, {}, &EdgeSides::boundary);
  return all;
}

/// Returns the one-sided edges of all ranks on the root, in the order of the cells. *Collective.*
std::vector<OuterSegment> outer_segments(const Communicator& comm, const HaloMesh& halo,
                                         const std::vector<OneSidedEdge>& edges) {
  std::vector<OuterSegment> own;
  for (const OneSidedEdge& edge : edges) {
    if (halo.owns(edge.from))
      own.push_back({edge.cell, edge.side, halo.point(edge.from), halo.point(edge.to)});
  }
  std::vector<OuterSegment> all = gather_at_root(comm, own);
  std::ranges::sort(all, [](const OuterSegment& a, const OuterSegment& b) {
    return std::pair(a.cell, a.side) < std::pair(b.cell, b.side);
  });
  return all;
}

}  // namespace

GeometryFit validate_geometry(const Communicator& comm, const Mesh& mesh, const HaloMesh& halo,
                              const EdgeStatistics& edges, std::span<const Chain> geometry,
                              const CellBlocks& blocks, double tolerance) {
  const std::vector<double> longest = longest_edge_of_cells(mesh);
  const MeshOutline outline{gather_boundaries(comm, mesh), sides_of_boundaries(comm, mesh, blocks, longest),
                            outer_segments(comm, halo, edges.one_sided), box_over_ranks(comm, mesh.points),
                            blocks.count};
  OutlineComparison compared;
  std::vector<ReachQuestion> questions;
  comm.together([&] {
    if (!comm.is_root()) return;
    compared = compare_outline(outline, geometry, tolerance);
    for (const PossibleFault& possible : compared.possible_faults) {
      if (possible.question) questions.push_back(*possible.question);
    }
  });
  add_confirmed(compared.possible_faults, answers_over(comm, mesh, longest, std::move(questions)),
                compared.fit);
  return compared.fit;
}

GeometryFit validate_geometry(const Mesh& whole, std::span<const Chain> geometry, const CellBlocks& blocks,
                              double tolerance) {
  const Communicator alone(MPI_COMM_SELF);
  const HaloMesh halo(alone, whole);
  return validate_geometry(alone, whole, halo, edge_statistics(alone, whole, halo, blocks), geometry, blocks,
                           tolerance);
}

}  // namespace quadloop
