#include <algorithm>
#include <array>
#include <bit>
#include <span>

#include "io/files/binary_output.hpp"
#include "io/files/row_output.hpp"
#include "io/model/pair_text.hpp"
#include "io/native/binary_file.hpp"
#include "io/native/binary_header.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop::io {

namespace {

class BinaryWriter {
 public:
  BinaryWriter(OutputSet& outputs, const MeshStream& stream, const std::string& path)
      : comm_{outputs.communicator()},
        mesh_{stream.extruded()->plane},
        solution_{stream.extruded()->solution},
        blocks_{stream.extruded()->blocks},
        boundaries_{*stream.boundaries()},
        file_{outputs, outputs.stage(path)} {
    header_.nodes = stream.counts().nodes;
    header_.node_bytes = node_bytes_for(header_.nodes);
    for (std::size_t n = 0; n < boundaries_.present().size(); ++n) {
      const BoundaryEdges& boundary = *boundaries_.present()[n];
      header_.boundaries.push_back(
          {boundary.name, boundary.condition, boundaries_.edges_of(n), boundary.layers, boundary.inner_line});
    }
    header_.comments = comments_of(mesh_);
    put_blocks(stream);
    if (solution_ == nullptr) return;
    header_.constants = std::ssize(solution_->constants);
    header_.variables = distinct_words(solution_->names, path);
    header_.cell_variables = distinct_words(solution_->cells.names, path);
  }

  void write() {
    file_.write(text_of(header_));
    write_rows(mesh_.owned_nodes, [&](std::size_t i) {
      return std::array{mesh_.points[i].x, mesh_.points[i].y};
    });
    if (header_.node_bytes == 4)
      write_connectivity<std::int32_t>();
    else
      write_connectivity<std::int64_t>();
    if (solution_ != nullptr) write_solution(*solution_);
    file_.close();
  }

 private:
  void put_blocks(const MeshStream& stream) {
    if (blocks_ == nullptr) {
      const StreamCounts& all = stream.counts();
      header_.blocks = {{"domain", all.of(CellKind::triangle), all.of(CellKind::quad)}};
      return;
    }
    for (std::int32_t b = 0; b < std::ssize(blocks_->names); ++b)
      header_.blocks.push_back({blocks_->names[b], comm_.sum(std::ranges::count(blocks_->of_triangles, b)),
                                comm_.sum(std::ranges::count(blocks_->of_quads, b))});
  }

  /// Writes the rows of all ranks in the order of ranks, each an array `make(i)`.
  template <class Make>
  void write_rows(std::size_t rows, const Make& make) {
    file_.write_rows(static_cast<std::int64_t>(rows),
                     [&](std::int64_t i) { return in_order<std::endian::little>(make(i)); });
  }

  template <class Number>
  void write_connectivity() {
    const auto numbers = [&]<std::size_t width>(const std::array<NodeId, width>& cell) {
      std::array<Number, width> row;
      for (std::size_t k = 0; k < width; ++k) row[k] = static_cast<Number>(mesh_.global(cell[k]).value());
      return row;
    };
    const auto write_cells = [&](const auto& cells) {
      write_rows(cells.size(), [&](std::size_t i) { return numbers(cells[i]); });
    };
    const auto write_by_block = [&](const auto& cells, std::vector<std::int32_t> PlaneBlocks::*of_cells) {
      if (blocks_ == nullptr) write_cells(cells);
      for (std::int32_t b = 0; blocks_ != nullptr && b < std::ssize(blocks_->names); ++b)
        write_cells(cells_of_block(cells, blocks_->*of_cells, b));
    };
    write_by_block(mesh_.triangles, &PlaneBlocks::of_triangles);
    write_by_block(mesh_.quads, &PlaneBlocks::of_quads);
    write_edges<Number>();
  }

  /// Boundary by boundary.
  template <class Number>
  void write_edges() {
    file_.write_edges(boundaries_, 1, [](const BoundaryStream::Edge& edge, std::int64_t) {
      return in_order<std::endian::little>(
          std::array{static_cast<Number>(edge[0]), static_cast<Number>(edge[1])});
    });
  }

  /// Writes the rows of one kind of cells, block by block.
  void write_cell_values(std::span<const double> rows, std::size_t width,
                         std::vector<std::int32_t> PlaneBlocks::*of_cells) {
    if (blocks_ == nullptr) write_values(rows.data(), rows.size());
    for (std::int32_t b = 0; blocks_ != nullptr && b < std::ssize(blocks_->names); ++b) {
      const std::vector<double> of_block = rows_of_block(rows, width, blocks_->*of_cells, b);
      write_values(of_block.data(), of_block.size());
    }
  }

  void write_solution(const Field& solution) {
    std::vector<double> constants;
    for (const double value : solution.constants) constants.push_back(in_order<std::endian::little>(value));
    file_.write(bytes_of(std::span<const double>(constants)));
    write_values(solution.values.data(), mesh_.owned_nodes * solution.width());
    const std::size_t width = solution.cells.width(), triangles = mesh_.triangles.size() * width;
    const std::span<const double> of_cells(solution.cells.values);
    write_cell_values(of_cells.first(triangles), width, &PlaneBlocks::of_triangles);
    write_cell_values(of_cells.subspan(triangles), width, &PlaneBlocks::of_quads);
  }

  void write_values(const double* values, std::size_t count) {
    write_rows(count, [&](std::size_t i) { return std::array{values[i]}; });
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  const Field* solution_;
  const PlaneBlocks* blocks_;  ///< null: one block
  const BoundaryStream& boundaries_;
  RowOutput file_;
  BinaryHeader header_;
};

}  // namespace

void write_binary(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  BinaryWriter(outputs, mesh, path).write();
}

}  // namespace quadloop::io
