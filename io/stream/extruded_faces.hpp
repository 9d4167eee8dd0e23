#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "io/model/extruded_mesh.hpp"
#include "io/text/text_output.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"

namespace quadloop {

/// The faces of an extruded mesh, for formats of faces, with the cells on their two sides. A face inside
/// stands with its cell of the lower number, that of the plane first; those of one cell by their other cell:
/// OpenFOAM's upper-triangular order.
class ExtrudedFaces {
 public:
  /// `numbers` are those by which a file knows this rank's cells of the plane, over all ranks from 0; empty:
  /// those that they have. Both must outlive it. *Collective.*
  ExtrudedFaces(const Communicator& comm, const ExtrudedMesh& mesh, std::vector<std::int64_t> numbers = {});

  std::int64_t internal() const { return internal_; }  ///< over all ranks

  /// The faces inside, those of this rank's cells: `put(text, nodes, owner, neighbour)` puts at most `width`
  /// numbers for one; its nodes counter-clockwise as seen from outside the owner. *Collective.*
  template <class Put>
  void write_internal(TextOutput& file, std::size_t width, const Put& put) const {
    write_internal_of(file, width, mesh_.plane.triangles, 0, cells_.first_triangle, put);
    write_internal_of(file, width, mesh_.plane.quads, 3 * mesh_.plane.triangles.size(), cells_.first_quad,
                      put);
  }

  /// The faces of an end: `put(text, nodes, owner)`, nodes counter-clockwise as seen from outside.
  /// *Collective.*
  template <class Put>
  void write_end(TextOutput& file, std::size_t width, bool front, const Put& put) const {
    const std::int64_t layer = front ? mesh_.layers() - 1 : 0;
    const auto write_of = [&](const auto& cells, std::int64_t first) {
      file.write_rows(std::ssize(cells), width, [&](TextRows& text, std::int64_t i) {
        put(text, front ? mesh_.front_face(cells[i]) : mesh_.back_face(cells[i]),
            own_number(first + i) * mesh_.layers() + layer);
      });
    };
    write_of(mesh_.plane.triangles, 0);
    write_of(mesh_.plane.quads, std::ssize(mesh_.plane.triangles));
  }

  /// The boundary edges of the plane; in the place of their nodes the number of the plane's cell beside them,
  /// and 0. *Collective.*
  BoundaryStream owners_along_sides() const;
  /// The two nodes, below 2^31, as side_nodes() finds them again, and the cell beside them. *Collective.*
  BoundaryStream sides_with_owners() const;
  static std::array<GlobalNodeId, 2> side_nodes(const BoundaryStream::Edge& edge) {
    return {GlobalNodeId{edge[0] >> 32}, GlobalNodeId{edge[0] & 0xffffffff}};
  }

 private:
  /// Cells of the plane by the edges of which they have one: the neighbours with higher numbers, ascending,
  /// each with the place of the edge in the cell.
  struct HigherNeighbours {
    struct Entry {
      std::int64_t cell;
      std::size_t edge;
    };
    std::array<Entry, 4> entries;
    std::size_t count = 0;

    void insert(Entry entry) {
      for (std::size_t i = 0; i < count; ++i) {
        if (entry.cell < entries[i].cell) std::swap(entry, entries[i]);
      }
      entries[count++] = entry;
    }
    auto begin() const { return entries.begin(); }
    auto end() const { return entries.begin() + count; }
  };

  template <std::size_t width>
  HigherNeighbours neighbours(std::size_t first_edge, std::int64_t number) const {
    HigherNeighbours found;
    for (std::size_t edge = 0; edge < width; ++edge) {
      const std::int64_t across = cells_.across[first_edge + edge];
      if (across > number) found.insert({across, edge});
    }
    return found;
  }

  /// `first_edge` is the place of the first of this rank's cell edges that are of such cells.
  template <std::size_t corners, class Put>
  void write_internal_of(TextOutput& file, std::size_t width,
                         const std::vector<std::array<NodeId, corners>>& plane_cells, std::size_t first_edge,
                         std::int64_t first_number, const Put& put) const {
    const std::int64_t layers = mesh_.layers();
    const std::int64_t first_local = first_edge == 0 ? 0 : std::ssize(mesh_.plane.triangles);
    file.write_rows(
        std::ssize(plane_cells) * layers, corners * width + width, [&](TextRows& text, std::int64_t i) {
          const std::int64_t cell = i / layers, layer = i % layers;
          const std::int64_t owner = own_number(first_local + cell) * layers + layer;
          const std::array<NodeId, corners>& nodes = plane_cells[cell];
          if (layer + 1 < layers) put(text, mesh_.face_at(nodes, layer + 1), owner, owner + 1);
          const std::size_t first = first_edge + cell * corners;
          for (const auto& [across, edge] : neighbours<corners>(first, first_number + cell)) {
            const NodeId from = nodes[edge], to = nodes[(edge + 1) % corners];
            put(text, mesh_.side(mesh_.plane.global(from), mesh_.plane.global(to), layer), owner,
                (across_numbers_.empty() ? across : across_numbers_[first + edge]) * layers + layer);
          }
        });
  }

  std::int64_t own_number(std::int64_t local) const {
    if (!numbers_.empty()) return numbers_[local];
    const std::int64_t triangles = std::ssize(mesh_.plane.triangles);
    return local < triangles ? cells_.first_triangle + local : cells_.first_quad + local - triangles;
  }
  void renumber();

  const Communicator& comm_;
  const ExtrudedMesh& mesh_;
  std::vector<std::int64_t> numbers_;
  EdgeCells cells_;
  std::vector<std::int64_t> across_numbers_;  ///< at each edge of this rank's cells; empty: as they are
  std::int64_t internal_ = 0;
};

}  // namespace quadloop
