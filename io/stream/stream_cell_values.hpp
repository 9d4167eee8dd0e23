#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// The cell values of a mesh that is written to a file: each cell of an extruded mesh has the values of the
/// plane cell below it. Rows are those of the stream. Faces of patches have the values of the adjacent cell,
/// for formats with cells and faces in one list.
class StreamCellValues {
 public:
  /// The stream must outlive the object. Throws OutputError if a patch face of a stored mesh belongs to no
  /// cell. *Collective.*
  explicit StreamCellValues(const MeshStream& stream);

  const std::vector<std::string>& names() const { return names_; }

  /// Value of a cell.
  template <CellKind kind>
  double of_cell(std::int64_t row, std::size_t variable) const {
    if (held_ != nullptr)
      return held_->solution->cells.values[held_row<kind>(row) * names_.size() + variable];
    constexpr bool is_quad = kind == CellKind::quad || kind == CellKind::hexahedron;
    return of_plane(row / layers_ + (is_quad ? plane_triangles() : 0), variable);
  }

  /// Value of a triangle (width 3), or a quad (4), of a patch that is not a side.
  template <std::size_t width>
  double of_face(std::size_t patch, std::int64_t row, std::size_t variable) const {
    if (held_ != nullptr) {
      const std::int64_t cell = (width == 3 ? of_triangles_ : of_quads_)[patch][row];
      return held_->solution->cells.values[cell * names_.size() + variable];
    }
    return of_plane(row + (width == 4 ? plane_triangles() : 0), variable);
  }

  /// The plane's boundary edges, each with the value of its cell, value_of(), which is that of its
  /// sides_on_edge() side faces; none of a stored mesh and without values. *Collective.*
  std::optional<BoundaryStream> at_sides(std::size_t variable) const;
  static double value_of(const BoundaryStream::Edge& edge) { return std::bit_cast<double>(edge[0]); }
  std::int64_t sides_on_edge() const { return layers_; }

 private:
  /// Returns the row among all stored cells, kind after kind.
  template <CellKind kind>
  std::int64_t held_row(std::int64_t row) const {
    for_each_kind([&]<CellKind before>() {
      if (before < kind) row += std::ssize(cells_of<before>(*held_));
    });
    return row;
  }
  std::int64_t plane_triangles() const { return std::ssize(stream_.extruded()->plane.triangles); }
  double of_plane(std::int64_t cell, std::size_t variable) const;
  void find_cells_beside();

  const MeshStream& stream_;
  const FileMesh* held_;
  std::int64_t layers_;  ///< rows per cell of the plane
  std::vector<std::string> names_;
  std::vector<std::int64_t> columns_;  ///< of an extruded mesh: column of each variable
  std::vector<double> at_edges_;       ///< plane columns at its boundary edges, row by row
  /// Of a stored mesh: cells adjacent to patch faces.
  std::vector<std::vector<std::int32_t>> of_triangles_, of_quads_;
};

}  // namespace quadloop::io
