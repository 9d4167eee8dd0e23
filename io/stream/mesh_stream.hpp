#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/files/boundary_stream.hpp"
#include "io/model/extruded_mesh.hpp"
#include "io/model/file_mesh.hpp"
#include "io/model/loaded_mesh.hpp"

namespace quadloop::io {

/// A boundary of a mesh that is written to a file.
struct StreamedPatch {
  std::string name;
  BoundaryCondition condition = {};
  std::int64_t edges = 0;                 ///< of a plane mesh
  std::int64_t triangles = 0, quads = 0;  ///< for a 3D mesh
  char axis = ' ';                        ///< normal axis: 'x', 'y', 'z', if known

  std::int64_t faces() const { return edges + triangles + quads; }
};

/// Numbers over all ranks.
struct StreamCounts {
  std::int64_t nodes = 0;
  std::array<std::int64_t, cell_kinds> of_kind{};

  std::int64_t of(CellKind kind) const { return of_kind[static_cast<std::size_t>(kind)]; }
  std::int64_t cells() const { return std::accumulate(of_kind.begin(), of_kind.end(), std::int64_t{0}); }
  /// Returns the length of the longest array: of the nodes, or of the node numbers of a kind of cells.
  std::int64_t largest_array() const;
};

/// A mesh that all ranks write to a file: a plane or extruded mesh, of which each rank creates its own rows,
/// or one stored on the only rank as it was in a file. Rows are those of this rank, from 0. Members are
/// *collective* where stated.
class MeshStream {
 public:
  /// The mesh and its data must outlive the object. *Collective.*
  MeshStream(const Communicator& comm, const ExtrudedMesh& mesh);
  /// A plane mesh, with its solution unless that is null, and its blocks if they have names.
  /// `choice`: whether the boundaries include inner lines.
  MeshStream(const Communicator& comm, const Mesh& plane, const Field* solution = nullptr,
             std::optional<PlaneBlocks> blocks = {}, EdgeChoice choice = EdgeChoice::boundaries);
  /// The same for a mesh that is whole on the only rank.
  MeshStream(const Communicator& comm, const LoadedMesh& whole, EdgeChoice choice = EdgeChoice::boundaries);
  /// A 3D mesh; `comm` must have one rank.
  MeshStream(const Communicator& comm, const FileMesh& mesh);
  MeshStream(const MeshStream&) = delete;
  MeshStream& operator=(const MeshStream&) = delete;

  const Communicator& communicator() const { return comm_; }
  bool is_plane() const { return extruded_ != nullptr && extruded_->layers() == 0; }
  /// The streamed mesh (for a plane mesh, one with a single level); null for the other kind.
  const ExtrudedMesh* extruded() const { return extruded_; }
  const FileMesh* held() const { return held_; }
  const StreamCounts& counts() const { return counts_; }
  /// For an extruded mesh: boundaries with edges in their order, the back, the front.
  const std::vector<StreamedPatch>& patches() const { return patches_; }
  /// Number of leading patches whose faces are at the edges of boundaries(): those of an extruded mesh except
  /// its ends, all of a plane mesh. The others have face_rows().
  std::size_t side_patches() const { return side_patches_; }
  std::vector<std::string> patch_names() const;
  std::int64_t patch_triangles() const;  ///< of all patches
  std::int64_t patch_quads() const;

  std::int64_t point_rows() const {
    return held_ != nullptr ? std::ssize(held_->points) : extruded_->point_rows();
  }
  Point3 point(std::int64_t row) const {
    return held_ != nullptr ? held_->points[row] : extruded_->point(row);
  }

  template <CellKind kind>
  std::int64_t cell_rows() const {
    if (held_ != nullptr) return std::ssize(cells_of<kind>(*held_));
    if constexpr (kind == CellKind::triangle) return is_plane() ? std::ssize(extruded_->plane.triangles) : 0;
    if constexpr (kind == CellKind::quad) return is_plane() ? std::ssize(extruded_->plane.quads) : 0;
    if constexpr (kind == CellKind::prism) return extruded_->prism_rows();
    if constexpr (kind == CellKind::hexahedron) return extruded_->hexahedron_rows();
    return 0;
  }
  template <CellKind kind>
  std::array<NodeNumber, cell_width<kind>> cell(std::int64_t row) const {
    if (held_ != nullptr) return widened(cells_of<kind>(*held_)[row]);
    if constexpr (kind == CellKind::triangle) return extruded_->face_at(extruded_->plane.triangles[row], 0);
    if constexpr (kind == CellKind::quad) return extruded_->face_at(extruded_->plane.quads[row], 0);
    if constexpr (kind == CellKind::prism) return extruded_->prism(row);
    if constexpr (kind == CellKind::hexahedron) return extruded_->hexahedron(row);
    return {};
  }

  /// Triangles (width 3), or quads (4), of a patch that is not a side.
  template <std::size_t width>
  std::int64_t face_rows(std::size_t patch) const {
    if (held_ != nullptr) return std::ssize(held_faces<width>(patch));
    return std::ssize(plane_cells<width>());
  }
  template <std::size_t width>
  std::array<NodeNumber, width> face(std::size_t patch, std::int64_t row) const {
    if (held_ != nullptr)
      return first_of<width>(held_->boundaries[patch].faces[held_faces<width>(patch)[row]]);
    const auto& cell = plane_cells<width>()[row];
    return patch == side_patches_ ? extruded_->back_face(cell) : extruded_->front_face(cell);
  }

  /// The boundary edges of a plane or extruded mesh, null for a stored mesh; each edge of an extruded mesh
  /// has one face per layer, side().
  const BoundaryStream* boundaries() const { return boundaries_ ? &*boundaries_ : nullptr; }
  std::int64_t layers() const { return extruded_ != nullptr ? extruded_->layers() : 0; }
  std::array<NodeNumber, 4> side(const BoundaryStream::Edge& edge, std::int64_t layer) const {
    return extruded_->side(GlobalNodeId{edge[0]}, GlobalNodeId{edge[1]}, layer);
  }

  /// The nodal solution: names, and the value of a variable at a row's point.
  const std::vector<std::string>& variables() const { return variables_; }
  double value(std::int64_t row, std::size_t variable) const {
    if (held_ != nullptr) return held_->solution->values[row * variables_.size() + variable];
    const std::int64_t column = columns_[variable];
    if (column == ExtrudedVariable::zero) return 0;
    const Field& plane = *extruded_->solution;
    return plane.values[row / extruded_->levels() * plane.width() + column];
  }

  /// Runs `action` on rank 0; if it throws, all ranks do. *Collective.*
  template <class Action>
  void on_root(const Action& action) const {
    comm_.together([&] {
      if (comm_.is_root()) action();
    });
  }

 private:
  void take_extruded(const ExtrudedMesh& mesh, EdgeChoice choice = EdgeChoice::boundaries);

  template <std::size_t width>
  static std::array<NodeNumber, width> widened(const std::array<std::int32_t, width>& nodes) {
    std::array<NodeNumber, width> result;
    for (std::size_t i = 0; i < width; ++i) result[i] = nodes[i];
    return result;
  }
  template <std::size_t width>
  static std::array<NodeNumber, width> first_of(const FileBoundary::Face& face) {
    std::array<NodeNumber, width> result;
    for (std::size_t i = 0; i < width; ++i) result[i] = face[i];
    return result;
  }
  template <std::size_t width>
  const std::vector<std::int32_t>& held_faces(std::size_t patch) const {
    return width == 3 ? held_triangles_[patch] : held_quads_[patch];
  }
  template <std::size_t width>
  const auto& plane_cells() const {
    if constexpr (width == 3) return extruded_->plane.triangles;
    if constexpr (width == 4) return extruded_->plane.quads;
  }

  const Communicator& comm_;
  const ExtrudedMesh* extruded_ = nullptr;  ///< either this or the next is set
  const FileMesh* held_ = nullptr;
  StreamCounts counts_;
  std::optional<PlaneBlocks> own_blocks_;     ///< of a plane mesh
  std::optional<ExtrudedMesh> own_plane_;     ///< with a single level
  std::optional<BoundaryStream> boundaries_;  ///< of a plane or extruded mesh
  /// For each patch: indices of its faces.
  std::vector<std::vector<std::int32_t>> held_triangles_, held_quads_;
  std::vector<StreamedPatch> patches_;
  std::size_t side_patches_ = 0;
  std::vector<std::string> variables_;
  std::vector<std::int64_t> columns_;  ///< of an extruded mesh: column of each variable
};

/// Converts a row to another number type, adding `more`.
template <class Number, std::size_t width>
std::array<Number, width> as(const std::array<NodeNumber, width>& nodes, NodeNumber more = 0) {
  std::array<Number, width> result;
  for (std::size_t i = 0; i < width; ++i) result[i] = static_cast<Number>(nodes[i] + more);
  return result;
}

}  // namespace quadloop::io
