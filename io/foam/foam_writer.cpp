#include <algorithm>
#include <utility>

#include "io/foam/foam_file.hpp"
#include "io/foam/foam_parts.hpp"
#include "io/text/plain_names.hpp"
#include "io/text/text_output.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"

namespace quadloop {

namespace {

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

class FoamWriter {
 public:
  FoamWriter(OutputSet& outputs, const SolidStream& stream, const std::string& path)
      : comm_{outputs.communicator()},
        stream_{stream},
        mesh_{*stream.extruded()},
        staged_{outputs.stage_folder(path, foam_files)},
        cells_{edge_cells(comm_, mesh_.plane)} {
    const auto inner = comm_.sum(std::ranges::count_if(cells_.across, [](std::int64_t cell) {
      return cell != EdgeCells::none;
    })) / 2;
    internal_faces_ =
        inner * mesh_.layers() + stream_.counts().cells() / mesh_.layers() * (mesh_.layers() - 1);
    faces_ = internal_faces_;
    for (const StreamedPatch& patch : stream_.patches()) faces_ += patch.faces();
  }

  void write() {
    write_foam_points(stream_, staged_[0]);
    write_faces();
    write_owner();
    write_neighbour();
    write_boundary();
  }

 private:
  /// `first_edge` is the place of the first of this rank's cell edges that are of such cells, `number` that
  /// of the cell.
  template <std::size_t width>
  HigherNeighbours neighbours(std::size_t cell, std::size_t first_edge, std::int64_t number) const {
    HigherNeighbours found;
    for (std::size_t edge = 0; edge < width; ++edge) {
      const std::int64_t across = cells_.across[first_edge + cell * width + edge];
      if (across > number) found.insert({across, edge});
    }
    return found;
  }

  /// The faces between two cells, those of this rank's cells, each with the lower cell: `above(text, cell,
  /// own, layer)` for the one in front of the cell, `beside(text, cell, own, layer, neighbour)` for those
  /// beside it; `own` and neighbours by numbers over all ranks in the plane.
  template <class Above, class Beside>
  void write_internal(TextOutput& file, std::size_t numbers, const Above& above, const Beside& beside) const {
    const auto write_of = [&]<std::size_t width>(const std::vector<std::array<NodeId, width>>& plane_cells,
                                                 std::size_t first_edge, std::int64_t first_number) {
      file.write_rows(std::ssize(plane_cells) * mesh_.layers(), 5 * numbers,
                      [&](TextRows& text, std::int64_t i) {
                        const std::int64_t cell = i / mesh_.layers(), layer = i % mesh_.layers(),
                                           own = first_number + cell;
                        const std::array<NodeId, width>& nodes = plane_cells[cell];
                        if (layer + 1 < mesh_.layers()) above(text, nodes, own, layer);
                        for (const auto& neighbour : neighbours<width>(cell, first_edge, own))
                          beside(text, nodes, own, layer, neighbour);
                      });
    };
    write_of(mesh_.plane.triangles, 0, cells_.first_triangle);
    write_of(mesh_.plane.quads, 3 * mesh_.plane.triangles.size(), cells_.first_quad);
  }

  void write_faces() {
    TextOutput file(comm_, staged_[1]);
    file.write(foam_head("faceList", "faces") + std::to_string(faces_) + "\n(\n");
    write_internal(
        file, 5,
        [&](TextRows& text, const auto& nodes, std::int64_t, std::int64_t layer) {
          put_foam_face(text, mesh_.face_at(nodes, layer + 1));
        },
        [&](TextRows& text, const auto& nodes, std::int64_t, std::int64_t layer, const auto& neighbour) {
          const NodeId from = nodes[neighbour.edge], to = nodes[(neighbour.edge + 1) % nodes.size()];
          put_foam_face(text, mesh_.side(mesh_.plane.global(from), mesh_.plane.global(to), layer));
        });
    write_patch_faces(file);
    file.write(")\n");
    file.close();
  }

  void write_patch_faces(TextOutput& file) const {
    file.write_boundaries(
        *stream_.boundaries(), 5 * mesh_.layers(), [](std::size_t) { return std::string(); },
        [&](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) {
          for (std::int64_t layer = 0; layer < mesh_.layers(); ++layer)
            put_foam_face(text, mesh_.side(GlobalNodeId{edge[0]}, GlobalNodeId{edge[1]}, layer));
        });
    for (const bool front : {false, true}) {
      const auto write_end = [&](const auto& cells) {
        file.write_rows(std::ssize(cells), 5, [&](TextRows& text, std::int64_t i) {
          put_foam_face(text, front ? mesh_.front_face(cells[i]) : mesh_.back_face(cells[i]));
        });
      };
      write_end(mesh_.plane.triangles);
      write_end(mesh_.plane.quads);
    }
  }

  std::string counts_note() const { return foam_counts_note(stream_.counts(), faces_, internal_faces_); }

  /// Of the face's cells that with the lower number.
  void write_owner() {
    TextOutput file(comm_, staged_[2]);
    file.write(foam_head("labelList", "owner", counts_note()) + std::to_string(faces_) + "\n(\n");
    const auto put_own = [&](TextRows& text, const auto&, std::int64_t own, std::int64_t layer,
                             const auto&...) { text.put(own * mesh_.layers() + layer, '\n'); };
    write_internal(file, 1, put_own, put_own);
    std::vector<BoundaryStream::Edge> left;
    for (const std::int64_t cell : cells_.of_boundary) left.push_back({cell, 0});
    file.write_boundaries(
        BoundaryStream(comm_, mesh_.plane, std::move(left)), mesh_.layers(),
        [](std::size_t) { return std::string(); },
        [&](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) {
          for (std::int64_t layer = 0; layer < mesh_.layers(); ++layer)
            text.put(edge[0] * mesh_.layers() + layer, '\n');
        });
    for (const std::int64_t layer : {std::int64_t{0}, mesh_.layers() - 1}) {
      const auto write_end = [&](const auto& cells, std::int64_t first) {
        file.write_rows(std::ssize(cells), 1, [&](TextRows& text, std::int64_t i) {
          text.put((first + i) * mesh_.layers() + layer, '\n');
        });
      };
      write_end(mesh_.plane.triangles, cells_.first_triangle);
      write_end(mesh_.plane.quads, cells_.first_quad);
    }
    file.write(")\n");
    file.close();
  }

  void write_neighbour() {
    TextOutput file(comm_, staged_[3]);
    file.write(foam_head("labelList", "neighbour", counts_note()) + std::to_string(internal_faces_) +
               "\n(\n");
    write_internal(
        file, 1,
        [&](TextRows& text, const auto&, std::int64_t own, std::int64_t layer) {
          text.put(own * mesh_.layers() + layer + 1, '\n');
        },
        [&](TextRows& text, const auto&, std::int64_t, std::int64_t layer, const auto& neighbour) {
          text.put(neighbour.cell * mesh_.layers() + layer, '\n');
        });
    file.write(")\n");
    file.close();
  }

  void write_boundary() {
    std::vector<std::string> types;
    for (const StreamedPatch& patch : stream_.patches()) types.push_back(foam_patch_type(patch.condition));
    for (std::size_t end = stream_.side_patches(); end < types.size(); ++end)
      types[end] = mesh_.layers() == 1 ? "empty" : "symmetryPlane";
    write_foam_boundary(comm_, staged_[4], stream_.patches(), types, internal_faces_);
  }

  const Communicator& comm_;
  const SolidStream& stream_;
  const ExtrudedMesh& mesh_;
  std::vector<StagedFile> staged_;
  EdgeCells cells_;
  std::int64_t internal_faces_ = 0, faces_ = 0;
};

}  // namespace

std::vector<std::string> foam_patch_names(const std::vector<std::string>& names) {
  return plain_words(names);
}

void write_foam(OutputSet& outputs, const SolidStream& mesh, const std::string& path) {
  if (mesh.held() != nullptr) return write_foam_held(outputs, mesh, path);
  FoamWriter(outputs, mesh, path).write();
}

}  // namespace quadloop
