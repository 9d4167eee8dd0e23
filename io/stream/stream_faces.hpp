#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/model/cell_faces.hpp"
#include "io/stream/held_faces.hpp"
#include "io/stream/mesh_stream.hpp"
#include "io/text/text_output.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"

namespace quadloop::io {

/// The faces of a mesh that is written to a file, for face-based formats, with the cells on both sides: edges
/// of a plane mesh, faces of three or four nodes of a 3D mesh. An inner face is listed with its cell of lower
/// number; those of one cell of a 3D mesh are ordered by their other cell (OpenFOAM's upper-triangular
/// order). Nodes are counter-clockwise as seen from outside the first cell; an edge has it on its left. Cells
/// and nodes are numbered from 0 over all ranks.
class StreamFaces {
 public:
  static constexpr std::int64_t no_cell = -1;

  /// Numbering of cells in the file: as in the stream, or with the cells of a block contiguous.
  enum class CellNumbers { as_streamed, by_block };

  /// The stream must outlive the object. Throws OutputError, with `path`, unless each face is between two
  /// cells or belongs to one cell and one patch. In a plane mesh with blocks a face of a patch may be between
  /// two cells. *Collective.*
  StreamFaces(const MeshStream& stream, CellNumbers numbers, const std::string& path);

  std::int64_t internal() const { return internal_; }
  std::int64_t all() const;
  /// Whether the faces of a patch are between cells.
  bool is_interface(std::size_t patch) const;

  /// An inner face on an inner line, by its number among the inner faces.
  struct LineFace {
    std::int64_t line;  ///< index of the boundary
    std::int64_t face;
    bool turned;  ///< whether the first cell is on the right of the line
  };
  /// Returns on rank 0 the faces on inner lines that are not written as patches, ordered by line, then face.
  /// Cells must be numbered as streamed, in a mesh that is not stored. *Collective.*
  std::vector<LineFace> inner_line_faces() const;

  /// Writes the inner faces: `put(text, nodes, owner, neighbour)` writes at most `width` numbers for one.
  /// *Collective.*
  template <class Put>
  void write_internal(TextOutput& file, std::size_t width, const Put& put) const {
    if (held_) {
      file.write_rows(std::ssize(held_->internal()), width, [&](TextRows& text, std::int64_t i) {
        const HeldFaces::Inner& face = held_->internal()[i];
        const auto put_face = [&](const auto& nodes) {
          put(text, nodes, number(face.owner), number(face.neighbour));
        };
        with_nodes(held_->nodes(face), put_face);
      });
    } else {
      const Mesh& plane = stream_.extruded()->plane;
      write_internal_of(file, width, plane.triangles, 0, put);
      write_internal_of(file, width, plane.quads, std::ssize(plane.triangles), put);
    }
  }

  /// Writes the faces of non-empty patches: `head(patch)` is the text before them, used on rank 0; `put(text,
  /// patch, nodes, owner, neighbour)` has neighbour no_cell except for an interface. *Collective.*
  template <class Head, class Put>
  void write_patches(TextOutput& file, std::size_t width, const Head& head, const Put& put) const {
    if (stream_.boundaries() != nullptr) write_sides(file, width, head, put);
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) {
      if (stream_.patches()[n].faces() == 0) continue;
      file.write(head(n));
      held_ ? write_held_patch(file, width, n, put) : write_end(file, width, n, put);
    }
  }

 private:
  using EdgeKey = std::array<GlobalNodeId, 2>;  ///< the lower node first
  /// Packs two numbers below 2^31 into one.
  static std::int64_t packed(std::int64_t first, std::int64_t second) { return first << 32 | second; }
  static std::array<std::int64_t, 2> unpacked(std::int64_t both) { return {both >> 32, both & 0xffffffff}; }

  /// The neighbours with higher numbers of a plane cell, each with the local number of the common edge.
  struct HigherNeighbours {
    struct Entry {
      std::int64_t cell;
      std::size_t edge;
    };
    std::array<Entry, 4> entries;
    std::size_t count = 0;

    void insert(Entry entry, bool sorted) {
      for (std::size_t i = 0; sorted && i < count; ++i) {
        if (entry.cell < entries[i].cell) std::swap(entry, entries[i]);
      }
      entries[count++] = entry;
    }
    auto begin() const { return entries.begin(); }
    auto end() const { return entries.begin() + count; }
  };

  template <std::size_t width>
  HigherNeighbours neighbours(const std::array<NodeId, width>& nodes, std::size_t first_edge,
                              std::int64_t number) const {
    HigherNeighbours found;
    for (std::size_t edge = 0; edge < width; ++edge) {
      const std::int64_t across = cells_.across[first_edge + edge];
      if (across > number && !is_between(nodes[edge], nodes[(edge + 1) % width]))
        found.insert({across, edge}, !stream_.is_plane());
    }
    return found;
  }

  /// Writes the inner faces of the plane cells with this number of corners; `before` of this rank's cells
  /// precede them.
  template <std::size_t corners, class Put>
  void write_internal_of(TextOutput& file, std::size_t width,
                         const std::vector<std::array<NodeId, corners>>& plane_cells, std::int64_t before,
                         const Put& put) const {
    const ExtrudedMesh& mesh = *stream_.extruded();
    const std::int64_t rows = rows_on_cell();
    const auto put_row = [&](TextRows& text, std::int64_t i) {
      const std::int64_t cell = i / rows, layer = i % rows;
      const std::int64_t owner = number(before + cell) * rows + layer;
      const std::array<NodeId, corners>& nodes = plane_cells[cell];
      if (layer + 1 < rows) put(text, mesh.face_at(nodes, layer + 1), owner, owner + 1);
      const std::size_t first = 3 * before + cell * corners;
      for (const auto& [across, edge] : neighbours(nodes, first, own_number(before + cell))) {
        const std::int64_t neighbour =
            (across_numbers_.empty() ? across : across_numbers_[first + edge]) * rows + layer;
        put_side(mesh.plane.global(nodes[edge]), mesh.plane.global(nodes[(edge + 1) % corners]), layer,
                 [&](const auto& side) { put(text, side, owner, neighbour); });
      }
    };
    file.write_rows(std::ssize(plane_cells) * rows, corners * width + width, put_row);
  }

  template <class Put>
  void put_side(GlobalNodeId from, GlobalNodeId to, std::int64_t layer, const Put& put) const {
    if (stream_.is_plane()) {
      put(std::array{from.value(), to.value()});
    } else {
      put(stream_.extruded()->side(from, to, layer));
    }
  }

  template <class Head, class Put>
  void write_sides(TextOutput& file, std::size_t width, const Head& head, const Put& put) const {
    const std::int64_t rows = rows_on_cell();
    const auto put_row = [&](TextRows& text, std::size_t n, const BoundaryStream::Edge& edge) {
      const auto [from, to] = unpacked(edge[0]);
      const auto [left, right_from_1] = unpacked(edge[1]);
      for (std::int64_t layer = 0; layer < rows; ++layer) {
        const std::int64_t owner = left * rows + layer, neighbour = right_from_1 - 1;
        put_side(GlobalNodeId{from}, GlobalNodeId{to}, layer,
                 [&](const auto& side) { put(text, n, side, owner, neighbour); });
      }
    };
    file.write_boundaries(sides(), width * rows, head, put_row);
  }

  /// The back, or the front, of an extruded mesh.
  template <class Put>
  void write_end(TextOutput& file, std::size_t width, std::size_t patch, const Put& put) const {
    const ExtrudedMesh& mesh = *stream_.extruded();
    const bool front = patch > stream_.side_patches();
    const std::int64_t layer = front ? mesh.layers() - 1 : 0;
    const auto write_of = [&](const auto& cells, std::int64_t before) {
      file.write_rows(std::ssize(cells), width, [&](TextRows& text, std::int64_t i) {
        put(text, patch, front ? mesh.front_face(cells[i]) : mesh.back_face(cells[i]),
            number(before + i) * mesh.layers() + layer, no_cell);
      });
    };
    write_of(mesh.plane.triangles, 0);
    write_of(mesh.plane.quads, std::ssize(mesh.plane.triangles));
  }

  template <class Put>
  void write_held_patch(TextOutput& file, std::size_t width, std::size_t patch, const Put& put) const {
    const std::vector<std::int32_t>& cells = held_->cells_at(patch);
    file.write_rows(std::ssize(cells), width, [&](TextRows& text, std::int64_t i) {
      const auto put_face = [&](const auto& nodes) { put(text, patch, nodes, number(cells[i]), no_cell); };
      with_nodes(held_->patch_nodes(patch, i), put_face);
    });
  }

  template <class Use>
  static void with_nodes(const FileBoundary::Face& face, const Use& use) {
    is_triangle(face) ? use(std::array{face[0], face[1], face[2]}) : use(face);
  }

  /// Number of cells, or side faces, on a cell, or edge, of the plane.
  std::int64_t rows_on_cell() const { return stream_.is_plane() ? 1 : stream_.layers(); }
  /// Returns the number in the file of a stored cell, or of one of this rank's plane cells.
  std::int64_t number(std::int64_t cell) const {
    if (!numbers_.empty()) return numbers_[cell];
    return held_ ? cell : own_number(cell);
  }
  /// Returns the number in the stream of one of this rank's plane cells.
  std::int64_t own_number(std::int64_t cell) const {
    const std::int64_t triangles = std::ssize(stream_.extruded()->plane.triangles);
    return cell < triangles ? cells_.first_triangle + cell : cells_.first_quad + cell - triangles;
  }
  EdgeKey key_of(NodeId from, NodeId to) const {
    const Mesh& mesh = stream_.extruded()->plane;
    const GlobalNodeId a = mesh.global(from), b = mesh.global(to);
    return {std::min(a, b), std::max(a, b)};
  }
  bool is_between(NodeId from, NodeId to) const {
    return !between_.empty() && between_.contains(key_of(from, to));
  }
  /// An edge of an inner line.
  struct LineEdge {
    EdgeKey key;
    std::int64_t line, cell;
    bool turned;  ///< as for LineFace
  };
  template <std::size_t corners>
  std::size_t side_of(const LineEdge& edge, const std::array<NodeId, corners>& nodes) const {
    std::size_t side = 0;
    while (key_of(nodes[side], nodes[(side + 1) % corners]) != edge.key) ++side;
    return side;
  }
  std::vector<LineEdge> line_edges(const CellOwners& owners) const;
  template <std::size_t corners>
  std::vector<std::int64_t> first_faces(const std::vector<std::array<NodeId, corners>>& cells,
                                        std::int64_t before, std::int64_t first) const;
  template <std::size_t corners>
  void append_line_faces(const LineEdge& edge, const std::array<NodeId, corners>& nodes,
                         std::size_t first_edge, std::int64_t first_face, std::vector<LineFace>& faces) const;
  /// Whether the edges of a boundary of the mesh are in the stream.
  bool is_streamed(const BoundaryEdges& boundary) const;
  bool streams_lines() const;
  void find_plane_faces(const std::string& path);
  void find_interfaces();
  void require_conforming(const std::string& path) const;
  void number_by_block();
  void renumber_across();
  BoundaryStream sides() const;

  const MeshStream& stream_;
  std::optional<HeldFaces> held_;  ///< either this or the following members, except for the numbers
  EdgeCells cells_;
  std::vector<std::int64_t> right_of_boundary_;  ///< interfaces only; may be empty
  std::set<EdgeKey> between_;                    ///< edges of interfaces at this rank's cells
  std::int64_t own_between_ = 0;                 ///< number of those that this rank stores
  std::set<std::int64_t> interfaces_;            ///< indices of boundaries with such edges, on any rank
  std::vector<std::int64_t> numbers_;            ///< of this rank's cells; empty: as in the stream
  std::vector<std::int64_t> across_numbers_;  ///< at each edge of this rank's cells; empty: as in the stream
  std::int64_t internal_ = 0;
};

}  // namespace quadloop::io
