#include <fmt/format.h>

#include "io/stream/block_meshes.hpp"
#include "io/stream/mesh_stream.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/stream/vtk_cell.hpp"
#include "io/su2/su2_file.hpp"
#include "io/su2/su2_text.hpp"
#include "io/text/plain_names.hpp"
#include "io/text/text_output.hpp"

namespace quadloop::io {

namespace {

/// Writes a mesh, or one zone of a file.
class Su2Writer {
 public:
  Su2Writer(TextOutput& file, const MeshStream& stream) : stream_{stream}, file_{file} {}

  void write() {
    file_.write((stream_.is_plane() ? "NDIME= 2\nNELEM= " : "NDIME= 3\nNELEM= ") +
                std::to_string(stream_.counts().cells()) + "\n");
    for_each_kind([&]<CellKind kind>() { write_cells<kind>(); });
    write_points();
    write_markers();
  }

 private:
  /// Rows of a plane mesh end with their global number `number`.
  void end_row(TextRows& text, std::int64_t number) const {
    if (stream_.is_plane()) {
      text.mark(' ');
      text.put(number, '\n');
    } else {
      text.mark('\n');
    }
  }

  template <CellKind kind>
  void write_cells() {
    const std::int64_t rows = stream_.cell_rows<kind>();
    const std::int64_t first = written_ + file_.communicator().exclusive_sum(rows);
    written_ += stream_.counts().of(kind);
    file_.write_rows(rows, cell_width<kind> + 2, [&](TextRows& text, std::int64_t i) {
      put_element(text, vtk_type_of<kind>, in_vtk_order(stream_.cell<kind>(i)));
      end_row(text, first + i);
    });
  }

  void write_points() {
    file_.write("NPOIN= " + std::to_string(stream_.counts().nodes) + "\n");
    const std::int64_t first = file_.communicator().exclusive_sum(stream_.point_rows());
    file_.write_rows(stream_.point_rows(), 4, [&](TextRows& text, std::int64_t i) {
      const Point3 p = stream_.point(i);
      text.put(p.x, ' ');
      text.put(p.y);
      if (!stream_.is_plane()) {
        text.mark(' ');
        text.put(p.z);
      }
      end_row(text, first + i);
    });
  }

  /// Writes type and nodes, without a line end.
  template <std::size_t width>
  static void put_element(TextRows& text, int type, const std::array<NodeNumber, width>& nodes) {
    text.put(type);
    for (const NodeNumber node : nodes) {
      text.mark(' ');
      text.put(node);
    }
  }

  void write_markers() {
    const std::vector<std::string> names = su2_marker_names(stream_.patch_names());
    const auto head = [&](std::size_t n) {
      return "MARKER_TAG= " + names[n] + "\nMARKER_ELEMS= " + std::to_string(stream_.patches()[n].faces()) +
             "\n";
    };
    file_.write("NMARK= " + std::to_string(names.size()) + "\n");
    if (stream_.boundaries() != nullptr)
      file_.write_boundaries(
          *stream_.boundaries(), 5 * std::max<std::int64_t>(1, stream_.layers()), head,
          [&](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) { put_sides(text, edge); });
    for (std::size_t n = stream_.side_patches(); n < names.size(); ++n) {
      file_.write(head(n));
      write_faces<3>(n);
      write_faces<4>(n);
    }
    if (stream_.is_plane()) write_pairs();
  }

  /// Writes what the solver's configuration must say of pairs, as a comment: one line for all pairs, because
  /// SU2 accepts a key once only.
  void write_pairs() {
    std::vector<std::string> entries;
    for (const PeriodicPair& pair : stream_.extruded()->plane.pairs) {
      const std::vector<std::string> names = su2_marker_names({pair.from, pair.to});
      entries.push_back(fmt::format("{}, {}, {}, {}, 0, 0, 0, {}, {}, {}, 0", names[0], names[1],
                                    pair.centre.x, pair.centre.y, pair.degrees, pair.translation.x,
                                    pair.translation.y));
    }
    if (!entries.empty()) file_.write(fmt::format("% MARKER_PERIODIC= ( {} )\n", fmt::join(entries, ", ")));
  }

  /// A line of a plane mesh, or a quad per layer.
  void put_sides(TextRows& text, const BoundaryStream::Edge& edge) const {
    if (stream_.is_plane()) {
      put_element(text, vtk_line, edge);
      text.mark('\n');
    }
    for (std::int64_t layer = 0; layer < stream_.layers(); ++layer) {
      put_element(text, vtk_quad, stream_.side(edge, layer));
      text.mark('\n');
    }
  }

  template <std::size_t width>
  void write_faces(std::size_t patch) {
    file_.write_rows(stream_.face_rows<width>(patch), width + 1, [&](TextRows& text, std::int64_t i) {
      put_element(text, width == 3 ? vtk_triangle : vtk_quad, stream_.face<width>(patch, i));
      text.mark('\n');
    });
  }

  const MeshStream& stream_;
  TextOutput& file_;
  std::int64_t written_ = 0;  ///< number of cells, over all ranks
};

}  // namespace

std::vector<std::string> su2_marker_names(const std::vector<std::string>& boundaries) {
  return plain_names(boundaries);
}

void write_su2(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  TextOutput file(outputs, path);
  const StreamBlocks blocks(mesh);
  if (!blocks.several()) {
    Su2Writer(file, mesh).write();
    return file.close();
  }
  file.write("NZONE= " + std::to_string(blocks.count()) + "\n");
  std::int32_t zone = 0;
  for (const auto& block : block_meshes(mesh, path)) {
    file.write("IZONE= " + std::to_string(++zone) + "\n" + su2_block_comment + block->name() + "\n");
    Su2Writer(file, block->stream()).write();
  }
  file.close();
}

}  // namespace quadloop::io
