#include "io/solid/solid_stream.hpp"

#include <algorithm>

#include "io/model/cell_faces.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

std::int64_t SolidCounts::largest_array() const {
  return std::max({nodes, 4 * tetrahedra, 5 * pyramids, 6 * prisms, 8 * hexahedra});
}

SolidStream::SolidStream(const Communicator& comm, const ExtrudedMesh& mesh) : comm_{comm}, extruded_{&mesh} {
  const ExtrudedCounts counts(comm, mesh);
  counts_ = {counts.nodes, 0, 0, counts.prisms, counts.hexahedra};
  boundaries_.emplace(comm, mesh.plane);
  for (std::size_t n = 0; n < boundaries_->present().size(); ++n) {
    const BoundaryEdges& boundary = *boundaries_->present()[n];
    patches_.push_back({boundary.name, boundary.condition, 0, boundaries_->edges_of(n) * mesh.layers()});
  }
  side_patches_ = patches_.size();
  for (const std::string& end : {mesh.back, mesh.front})
    patches_.push_back(
        {end, "symmetry", counts.triangles, counts.quads, mesh.axis == ExtrusionAxis::y ? 'y' : 'z'});
  if (mesh.solution == nullptr) return;
  for (const ExtrudedVariable& variable : extruded_variables(mesh.solution->names, mesh.axis)) {
    variables_.push_back(variable.name);
    columns_.push_back(variable.column);
  }
}

SolidStream::SolidStream(const Communicator& comm, const FileMesh& mesh) : comm_{comm}, held_{&mesh} {
  QUADLOOP_REQUIRE(comm.size() == 1, "a 3D mesh that is held is written by one rank");
  const auto count = [](const auto& rows) { return std::ssize(rows); };
  counts_ = {count(mesh.points), count(mesh.tetrahedra), count(mesh.pyramids), count(mesh.prisms),
             count(mesh.hexahedra)};
  for (const FileBoundary& patch : mesh.boundaries) {
    std::vector<std::int32_t>& triangles = held_triangles_.emplace_back();
    std::vector<std::int32_t>& quads = held_quads_.emplace_back();
    for (std::int32_t i = 0; i < count(patch.faces); ++i)
      (is_triangle(patch.faces[i]) ? triangles : quads).push_back(i);
    patches_.push_back({patch.name, patch.condition, count(triangles), count(quads)});
  }
  if (mesh.solution) variables_ = mesh.solution->names;
}

std::vector<std::string> SolidStream::patch_names() const {
  std::vector<std::string> names;
  for (const StreamedPatch& patch : patches_) names.push_back(patch.name);
  return names;
}

std::int64_t SolidStream::patch_triangles() const {
  std::int64_t sum = 0;
  for (const StreamedPatch& patch : patches_) sum += patch.triangles;
  return sum;
}

std::int64_t SolidStream::patch_quads() const {
  std::int64_t sum = 0;
  for (const StreamedPatch& patch : patches_) sum += patch.quads;
  return sum;
}

}  // namespace quadloop
