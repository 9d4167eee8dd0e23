#include "io/stream/mesh_stream.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "io/model/cell_faces.hpp"
#include "io/stream/stream_blocks.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

std::int64_t StreamCounts::largest_array() const {
  std::int64_t largest = nodes;
  for_each_kind([&]<CellKind kind>() {
    largest = std::max(largest, static_cast<std::int64_t>(cell_width<kind>) * of(kind));
  });
  return largest;
}

MeshStream::MeshStream(const Communicator& comm, const ExtrudedMesh& mesh) : comm_{comm} {
  take_extruded(mesh);
  const std::int64_t triangles = comm.sum(std::ssize(mesh.plane.triangles)),
                     quads = comm.sum(std::ssize(mesh.plane.quads));
  for (const std::string& end : {mesh.back, mesh.front})
    patches_.push_back(
        {end, BoundaryCondition::symmetry, 0, triangles, quads, mesh.axis == ExtrusionAxis::y ? 'y' : 'z'});
  if (mesh.solution == nullptr) return;
  for (const ExtrudedVariable& variable : extruded_variables(mesh.solution->names, mesh.axis)) {
    variables_.push_back(variable.name);
    columns_.push_back(variable.column);
  }
}

MeshStream::MeshStream(const Communicator& comm, const Mesh& plane, const Field* solution,
                       std::optional<PlaneBlocks> blocks, EdgeChoice choice)
    : comm_{comm}, own_blocks_{std::move(blocks)} {
  own_plane_.emplace(ExtrudedMesh{plane, {0.0}});
  own_plane_->solution = solution;
  if (own_blocks_) own_plane_->blocks = &*own_blocks_;
  take_extruded(*own_plane_, choice);
  if (solution == nullptr) return;
  variables_ = solution->names;
  columns_.resize(variables_.size());
  std::iota(columns_.begin(), columns_.end(), std::int64_t{0});
}

MeshStream::MeshStream(const Communicator& comm, const LoadedMesh& whole, EdgeChoice choice)
    : MeshStream(comm, whole.mesh, whole.solution ? &*whole.solution : nullptr,
                 has_named_blocks(whole) ? std::optional(plane_blocks(whole)) : std::nullopt, choice) {}

/// Sets the counts, and the boundaries of the plane.
void MeshStream::take_extruded(const ExtrudedMesh& mesh, EdgeChoice choice) {
  extruded_ = &mesh;
  counts_.nodes = comm_.sum(mesh.point_rows());
  for_each_kind([&]<CellKind kind>() {
    counts_.of_kind[static_cast<std::size_t>(kind)] = comm_.sum(cell_rows<kind>());
  });
  boundaries_.emplace(comm_, mesh.plane, choice);
  for (std::size_t n = 0; n < boundaries_->present().size(); ++n) {
    const BoundaryEdges& boundary = *boundaries_->present()[n];
    const std::int64_t edges = boundaries_->edges_of(n);
    patches_.push_back({boundary.name, boundary.condition, is_plane() ? edges : 0, 0, edges * mesh.layers()});
  }
  side_patches_ = patches_.size();
}

MeshStream::MeshStream(const Communicator& comm, const FileMesh& mesh) : comm_{comm}, held_{&mesh} {
  QUADLOOP_REQUIRE(comm.size() == 1, "a 3D mesh that is held is written by one rank", comm.size());
  counts_.nodes = std::ssize(mesh.points);
  for_each_kind([&]<CellKind kind>() {
    counts_.of_kind[static_cast<std::size_t>(kind)] = std::ssize(cells_of<kind>(mesh));
  });
  for (const FileBoundary& patch : mesh.boundaries) {
    std::vector<std::int32_t>& triangles = held_triangles_.emplace_back();
    std::vector<std::int32_t>& quads = held_quads_.emplace_back();
    for (std::int32_t i = 0; i < std::ssize(patch.faces); ++i)
      (is_triangle(patch.faces[i]) ? triangles : quads).push_back(i);
    patches_.push_back({patch.name, patch.condition, 0, std::ssize(triangles), std::ssize(quads)});
  }
  if (mesh.solution) variables_ = mesh.solution->names;
}

std::vector<std::string> MeshStream::patch_names() const {
  std::vector<std::string> names;
  for (const StreamedPatch& patch : patches_) names.push_back(patch.name);
  return names;
}

std::int64_t MeshStream::patch_triangles() const {
  std::int64_t sum = 0;
  for (const StreamedPatch& patch : patches_) sum += patch.triangles;
  return sum;
}

std::int64_t MeshStream::patch_quads() const {
  std::int64_t sum = 0;
  for (const StreamedPatch& patch : patches_) sum += patch.quads;
  return sum;
}

}  // namespace quadloop::io
