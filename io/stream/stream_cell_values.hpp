#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// The solution in the cells of a mesh on its way into a file: of an extruded one each cell has the values
/// of the plane's cell that it stands on. Rows are those of the stream. Faces of patches have the values of
/// the cell beside them, for formats that keep cells and faces in one list.
class StreamCellValues {
 public:
  /// The stream must outlive it. *Collective.* Throws OutputError where a face of a patch that is held
  /// belongs to no cell.
  explicit StreamCellValues(const MeshStream& stream);

  const std::vector<std::string>& names() const { return names_; }

  /// Of a cell.
  template <CellKind kind>
  double of_cell(std::int64_t row, std::size_t variable) const {
    if (held_ != nullptr)
      return held_->solution->cells.values[held_row<kind>(row) * names_.size() + variable];
    constexpr bool is_quad = kind == CellKind::quad || kind == CellKind::hexahedron;
    return of_plane(row / layers_ + (is_quad ? plane_triangles() : 0), variable);
  }

  /// Of a triangle (width 3), or a quad (4), of a patch that is none of the sides.
  template <std::size_t width>
  double of_face(std::size_t patch, std::int64_t row, std::size_t variable) const {
    if (held_ != nullptr) {
      const std::int64_t cell = (width == 3 ? of_triangles_ : of_quads_)[patch][row];
      return held_->solution->cells.values[cell * names_.size() + variable];
    }
    return of_plane(row + (width == 4 ? plane_triangles() : 0), variable);
  }

  /// Those at the faces of the sides, in the stream's order: pieces of them go to `put` on rank 0.
  /// *Collective.*
  template <class Put>
  void sides(std::size_t variable, const Put& put) const {
    if (held_ != nullptr || names_.empty()) return;
    std::vector<double> values;
    along_sides(variable).run([](std::size_t) {},
                              [&](std::span<const BoundaryStream::Edge> edges) {
                                for (const BoundaryStream::Edge& edge : edges) {
                                  values.assign(layers_, std::bit_cast<double>(edge[0]));
                                  put(std::span<const double>(values));
                                }
                              });
  }

 private:
  /// Among all cells that are held, kind after kind.
  template <CellKind kind>
  std::int64_t held_row(std::int64_t row) const {
    for_each_kind([&]<CellKind before>() {
      if (before < kind) row += std::ssize(cells_of<before>(*held_));
    });
    return row;
  }
  std::int64_t plane_triangles() const { return std::ssize(stream_.extruded()->plane.triangles); }
  double of_plane(std::int64_t cell, std::size_t variable) const;
  /// The plane's boundary edges, in the place of their nodes the bits of the value beside them.
  BoundaryStream along_sides(std::size_t variable) const;
  void find_cells_beside();

  const MeshStream& stream_;
  const FileMesh* held_;
  std::int64_t layers_;  ///< rows on each cell of the plane
  std::vector<std::string> names_;
  std::vector<std::int64_t> columns_;  ///< of an extruded mesh: of each variable
  std::vector<double> at_edges_;       ///< and rows of the plane's columns at its boundary edges
  std::vector<std::vector<std::int32_t>> of_triangles_, of_quads_;  ///< of a held mesh: cells beside patches
};

}  // namespace quadloop
