#include "io/stream/stream_cell_values.hpp"

#include <algorithm>

#include "io/model/cell_faces.hpp"
#include "io/model/mesh3d_faces.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"

namespace quadloop::io {

StreamCellValues::StreamCellValues(const MeshStream& stream)
    : stream_{stream}, held_{stream.held()}, layers_{std::max<std::int64_t>(1, stream.layers())} {
  if (held_ != nullptr) {
    if (!held_->solution || held_->solution->cells.names.empty()) return;
    names_ = held_->solution->cells.names;
    find_cells_beside();
    return;
  }
  const ExtrudedMesh& mesh = *stream.extruded();
  if (mesh.solution == nullptr || mesh.solution->cells.names.empty()) return;
  const CellValues& plane = mesh.solution->cells;
  if (stream.is_plane()) {
    for (const std::string& name : plane.names) {
      columns_.push_back(std::ssize(names_));
      names_.push_back(name);
    }
  } else {
    for (const ExtrudedVariable& variable : extruded_variables(plane.names, mesh.axis)) {
      names_.push_back(variable.name);
      columns_.push_back(variable.column);
    }
  }
  const Communicator& comm = stream.communicator();
  const std::vector<std::int64_t> beside = edge_cells(comm, mesh.plane).of_boundary;
  at_edges_ = rows_of_cells(comm, CellOwners(comm, mesh.plane), std::span<const std::int64_t>(beside),
                            plane.values, plane.width());
}

double StreamCellValues::of_plane(std::int64_t cell, std::size_t variable) const {
  const std::int64_t column = columns_[variable];
  const CellValues& plane = stream_.extruded()->solution->cells;
  return column == ExtrudedVariable::zero ? 0 : plane.values[cell * plane.width() + column];
}

/// Instead of node numbers each edge has the bits of the value.
std::optional<BoundaryStream> StreamCellValues::at_sides(std::size_t variable) const {
  if (held_ != nullptr || names_.empty()) return {};
  const ExtrudedMesh& mesh = *stream_.extruded();
  const std::size_t width = mesh.solution->cells.width();
  const std::int64_t column = columns_[variable];
  std::vector<BoundaryStream::Edge> bits;
  for (std::size_t row = 0; row < at_edges_.size(); row += width) {
    const double value = column == ExtrudedVariable::zero ? 0 : at_edges_[row + column];
    bits.push_back({std::bit_cast<std::int64_t>(value), 0});
  }
  return BoundaryStream(stream_.communicator(), mesh.plane, std::move(bits), stream_.boundaries()->choice());
}

/// Among the occurrences of a face patches come first.
void StreamCellValues::find_cells_beside() {
  std::vector<std::vector<std::int32_t>> beside;
  for (const FileBoundary& patch : held_->boundaries) beside.emplace_back(patch.faces.size(), -1);
  for_each_face(*held_, [&](std::int32_t, std::span<const FaceMention> mentions) {
    for (const FaceMention& mention : mentions) {
      if (mention.owner < 0) beside[-1 - mention.owner][mention.number] = mentions.back().owner;
    }
  });
  for (std::size_t p = 0; p < beside.size(); ++p) {
    std::vector<std::int32_t>& triangles = of_triangles_.emplace_back();
    std::vector<std::int32_t>& quads = of_quads_.emplace_back();
    for (std::size_t i = 0; i < beside[p].size(); ++i) {
      if (beside[p][i] < 0)
        throw OutputError(
            "face " + std::to_string(i + 1) + " of patch " + held_->boundaries[p].name +
            " belongs to no cell, whose values it would have; `quadloop check` lists all faults");
      (is_triangle(held_->boundaries[p].faces[i]) ? triangles : quads).push_back(beside[p][i]);
    }
  }
}

}  // namespace quadloop::io
