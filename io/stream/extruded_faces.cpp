#include "io/stream/extruded_faces.hpp"

#include <algorithm>
#include <span>

#include "mesher/mesh/cells/cell_owners.hpp"

namespace quadloop {

ExtrudedFaces::ExtrudedFaces(const Communicator& comm, const ExtrudedMesh& mesh,
                             std::vector<std::int64_t> numbers)
    : comm_{comm}, mesh_{mesh}, numbers_{std::move(numbers)}, cells_{edge_cells(comm, mesh.plane)} {
  const auto inner = comm.sum(std::ranges::count_if(cells_.across, [](std::int64_t cell) {
    return cell != EdgeCells::none;
  })) / 2;
  const auto cells = comm.sum(std::ssize(mesh.plane.triangles) + std::ssize(mesh.plane.quads));
  internal_ = inner * mesh.layers() + cells * (mesh.layers() - 1);
  if (comm.any(!numbers_.empty())) renumber();
}

/// Of the cells beside boundaries too.
void ExtrudedFaces::renumber() {
  std::vector<std::int64_t> wanted;
  for (const auto* cells : {&cells_.across, &cells_.of_boundary}) {
    std::ranges::copy_if(*cells, std::back_inserter(wanted),
                         [](std::int64_t cell) { return cell != EdgeCells::none; });
  }
  const std::vector<std::int64_t> found =
      rows_of_cells(comm_, CellOwners(comm_, mesh_.plane), std::span<const std::int64_t>(wanted), numbers_);
  auto next = found.begin();
  for (const std::int64_t cell : cells_.across)
    across_numbers_.push_back(cell == EdgeCells::none ? cell : *next++);
  for (std::int64_t& cell : cells_.of_boundary) {
    if (cell != EdgeCells::none) cell = *next++;
  }
}

BoundaryStream ExtrudedFaces::owners_along_sides() const {
  std::vector<BoundaryStream::Edge> owners;
  for (const std::int64_t cell : cells_.of_boundary) owners.push_back({cell, 0});
  return {comm_, mesh_.plane, std::move(owners)};
}

BoundaryStream ExtrudedFaces::sides_with_owners() const {
  std::vector<BoundaryStream::Edge> sides;
  auto cell = cells_.of_boundary.begin();
  for (const BoundaryEdges& boundary : mesh_.plane.boundaries) {
    for (const auto& [from, to] : boundary.edges)
      sides.push_back({mesh_.plane.global(from).value() << 32 | mesh_.plane.global(to).value(), *cell++});
  }
  return {comm_, mesh_.plane, std::move(sides)};
}

}  // namespace quadloop
