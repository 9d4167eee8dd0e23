#include "io/model/inner_curves.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "io/model/repeated_rows.hpp"
#include "mesher/base/counted.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"

namespace quadloop::io {

namespace {

/// Moves the edges for which `is_inside(edge)`, called for all in their order, to inner curves. *Collective.*
template <class IsInside>
void move_to_inner_curves(const Communicator& comm, const IsInside& is_inside, LoadedMesh& loaded,
                          const std::string& path) {
  std::vector<BoundaryEdges>& boundaries = loaded.mesh.boundaries;
  std::vector<BoundaryEdges> curves;
  std::vector<std::int64_t> counts;  // for each boundary: edges inside, and others
  for (BoundaryEdges& boundary : boundaries) {
    BoundaryEdges& curve = curves.emplace_back(BoundaryEdges{boundary.name, {}, {}});
    for (const auto& edge : std::exchange(boundary.edges, {}))
      (is_inside(edge) ? curve : boundary).edges.push_back(edge);
    counts.insert(counts.end(), {std::ssize(curve.edges), std::ssize(boundary.edges)});
  }
  counts = comm.sum(counts);
  std::vector<std::string> names;
  std::int64_t count = 0;
  for (std::size_t b = 0; b < curves.size(); ++b) {
    if (counts[2 * b] == 0) continue;
    count += counts[2 * b];
    names.push_back(curves[b].name);
    loaded.inner_curves.push_back(std::move(curves[b]));
  }
  if (names.empty()) return;
  std::erase_if(boundaries,
                [&, b = std::size_t{0}](const auto&) mutable { return counts[2 * b++ + 1] == 0; });
  loaded.warnings.push_back(fmt::format("{}: {} between two cells {} to inner lines, not to boundaries: {}",
                                        path, counted(count, "edge"), count == 1 ? "belongs" : "belong",
                                        some_names(names)));
}

}  // namespace

void separate_inner_curves(LoadedMesh& loaded, const EdgeTable& table, const std::string& path) {
  const auto is_inside = [&](const std::array<NodeId, 2>& edge) {
    const std::int32_t left = table.cell_left_of(edge[0], edge[1]),
                       right = table.cell_left_of(edge[1], edge[0]);
    return left >= 0 && right >= 0 && block_of_cell(loaded, left) == block_of_cell(loaded, right);
  };
  move_to_inner_curves(Communicator(MPI_COMM_SELF), is_inside, loaded, path);
}

void separate_inner_curves(const Communicator& comm, LoadedMesh& loaded, const std::string& path) {
  const std::vector<std::int64_t> right = cells_right_of_boundaries(comm, loaded.mesh);
  const auto is_there = [](std::int64_t cell) { return cell != EdgeCells::none; };
  if (!comm.any(std::ranges::any_of(right, is_there))) return;
  const std::vector<std::int64_t> left = cells_left_of_boundaries(comm, loaded.mesh);
  std::size_t edge = 0;
  move_to_inner_curves(
      comm,
      [&](const auto&) {
        const bool inside = is_there(left[edge]) && is_there(right[edge]);
        ++edge;
        return inside;
      },
      loaded, path);
}

void drop_empty_boundaries(const Communicator& comm, Mesh& mesh) {
  std::vector<std::int64_t> edges;
  for (const BoundaryEdges& boundary : mesh.boundaries) edges.push_back(std::ssize(boundary.edges));
  edges = comm.sum(edges);
  std::erase_if(mesh.boundaries, [&, b = std::size_t{0}](const auto&) mutable { return edges[b++] == 0; });
}

}  // namespace quadloop::io
