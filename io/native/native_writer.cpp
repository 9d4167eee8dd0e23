#include "io/model/layers_text.hpp"
#include "io/model/line_text.hpp"
#include "io/model/loaded_mesh.hpp"
#include "io/model/pair_text.hpp"
#include "io/native/native_file.hpp"
#include "io/text/text_output.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop::io {

namespace {

class NativeWriter {
 public:
  NativeWriter(OutputSet& outputs, const MeshStream& stream, const std::string& path)
      : comm_{outputs.communicator()},
        mesh_{stream.extruded()->plane},
        blocks_{stream.extruded()->blocks},
        path_{path},
        file_{outputs, path} {}

  void write_mesh() {
    write_nodes();
    const std::size_t blocks = blocks_ == nullptr ? 1 : blocks_->names.size();
    file_.write("#Number of blocks\n" + std::to_string(blocks) + "\n");
    if (blocks_ == nullptr) write_cells(mesh_.triangles, mesh_.quads);
    for (std::int32_t block = 0; blocks_ != nullptr && block < std::ssize(blocks_->names); ++block) {
      file_.write(block_text(blocks_->names, block));
      write_cells(cells_of_block(mesh_.triangles, blocks_->of_triangles, block),
                  cells_of_block(mesh_.quads, blocks_->of_quads, block));
    }
    write_boundaries();
  }

  void write_solution(const Field& solution) {
    std::string head = "#Number of constants\n" + std::to_string(solution.constants.size()) + "\n";
    TextRows constants(std::ssize(solution.constants), 1);
    for (const double value : solution.constants) constants.put(value, '\n');
    const std::vector<char> text = constants.take();
    head.append(text.begin(), text.end());
    head += "#Number of variables\n" + std::to_string(solution.names.size()) + "\n#names:";
    for (const std::string& name : distinct_words(solution.names, path_)) head += " " + name;
    file_.write(head + "\n");
    write_real_rows(mesh_.owned_nodes, solution.values.data(), solution.names.size());
    if (solution.cells.width() > 0) write_cell_values(solution.cells);
  }

  void close() { file_.close(); }

 private:
  void write_cells(const std::vector<std::array<NodeId, 3>>& triangles,
                   const std::vector<std::array<NodeId, 4>>& quads) {
    write_connectivity("#Number of triangular elements\n", triangles);
    write_connectivity("#Number of quadrilateral elements\n", quads);
  }

  void write_nodes() {
    file_.write("#Number of grid points\n" + std::to_string(comm_.sum(mesh_.owned_nodes)) + "\n");
    file_.write_rows(mesh_.owned_nodes, 2, [&](TextRows& text, std::size_t i) {
      text.put(mesh_.points[i].x, ' ');
      text.put(mesh_.points[i].y, '\n');
    });
  }

  void write_cell_values(const CellValues& cells) {
    std::string head = "#Number of cell variables\n" + std::to_string(cells.width()) + "\n#names:";
    for (const std::string& name : distinct_words(cells.names, path_)) head += " " + name;
    file_.write(head + "\n");
    const std::size_t width = cells.width();
    const std::span<const double> values(cells.values);
    const auto write_kind = [&](std::span<const double> rows, const std::vector<std::int32_t>* blocks) {
      if (blocks == nullptr) return write_real_rows(rows.size() / width, rows.data(), width);
      for (std::int32_t block = 0; block < std::ssize(blocks_->names); ++block) {
        const std::vector<double> of_block = rows_of_block(rows, width, *blocks, block);
        write_real_rows(of_block.size() / width, of_block.data(), width);
      }
    };
    const std::size_t triangles = mesh_.triangles.size() * width;
    write_kind(values.first(triangles), blocks_ == nullptr ? nullptr : &blocks_->of_triangles);
    write_kind(values.subspan(triangles), blocks_ == nullptr ? nullptr : &blocks_->of_quads);
  }

  /// Writes `rows` rows of this rank, each of `width` numbers.
  void write_real_rows(std::size_t rows, const double* values, std::size_t width) {
    if (width == 0) return;
    file_.write_rows(rows, width, [&](TextRows& text, std::size_t i) {
      for (std::size_t k = 0; k < width; ++k) text.put(values[i * width + k], k + 1 < width ? ' ' : '\n');
    });
  }

  template <std::size_t width>
  void write_connectivity(const std::string& comment, const std::vector<std::array<NodeId, width>>& rows) {
    file_.write(comment + std::to_string(comm_.sum(std::ssize(rows))) + "\n");
    file_.write_rows(rows.size(), width, [&](TextRows& text, std::size_t i) {
      for (std::size_t k = 0; k < width; ++k)
        text.put(mesh_.global(rows[i][k]).value() + 1, k + 1 < width ? ' ' : '\n');
    });
  }

  void write_boundaries() {
    const BoundaryStream boundaries(comm_, mesh_);
    file_.write("#Number of boundaries\n" + std::to_string(boundaries.present().size()) + "\n");
    file_.write_boundaries(
        boundaries, 2,
        [&](std::size_t n) {
          const BoundaryEdges& boundary = *boundaries.present()[n];
          return layers_text(boundary) + "#Number of edges for boundary " + std::to_string(n + 1) + " (" +
                 boundary.name + ")\n" + std::to_string(boundaries.edges_of(n)) + "\n";
        },
        [](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) {
          text.put(edge[0] + 1, ' ');
          text.put(edge[1] + 1, '\n');
        });
    write_lines();
    file_.write(comments_of(mesh_));
  }

  /// A block without a name of its own has no comment.
  static std::string block_text(const std::vector<std::string>& names, std::int32_t block) {
    const std::string& name = names[block];
    return name == usual_block_name(size32(names), block) ? "" : "# block " + name + "\n";
  }

  /// Inner lines are comments: to a solver they are no boundaries.
  void write_lines() {
    const BoundaryStream lines(comm_, mesh_, EdgeChoice::inner_lines);
    file_.write_boundaries(
        lines, 3, [&](std::size_t n) { return line_comment(lines.present()[n]->name, lines.edges_of(n)); },
        [](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) {
          text.mark('#');
          text.mark(' ');
          text.put(edge[0] + 1, ' ');
          text.put(edge[1] + 1, '\n');
        });
  }

  static std::string layers_text(const BoundaryEdges& boundary) {
    if (boundary.layers.count == 0) return {};
    return "# layers " + boundary.name + " " + text_of_layers(boundary.layers) + "\n";
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  const PlaneBlocks* blocks_;  ///< null: one block
  std::string path_;
  TextOutput file_;
};

}  // namespace

void write_native(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  NativeWriter writer(outputs, mesh, path);
  writer.write_mesh();
  if (const Field* solution = mesh.extruded()->solution; solution != nullptr)
    writer.write_solution(*solution);
  writer.close();
}

}  // namespace quadloop::io
