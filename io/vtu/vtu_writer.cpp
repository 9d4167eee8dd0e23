#include <bit>
#include <span>

#include "io/loaded/strip_text.hpp"
#include "io/text/text_output.hpp"
#include "io/vtu/vtu_cell.hpp"
#include "io/vtu/vtu_file.hpp"
#include "io/vtu/vtu_layers.hpp"
#include "io/vtu/vtu_text.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/mesh/layer_nodes.hpp"

namespace quadloop {

namespace {

std::string array_tag(const std::string& type, const std::string& name, int components = 1) {
  std::string tag = "<DataArray type=\"" + type + "\" Name=\"" + xml_escaped(name) + "\"";
  if (components > 1) tag += " NumberOfComponents=\"" + std::to_string(components) + "\"";
  return tag + " format=\"ascii\">\n";
}

class VtuWriter {
 public:
  VtuWriter(OutputSet& outputs, const Mesh& mesh, const std::string& path)
      : comm_{outputs.communicator()}, mesh_{mesh}, file_{outputs, path}, boundaries_{comm_, mesh} {}

  void write(const LoadedMesh* blocks, const Field* solution) {
    write_head(blocks);
    write_points();
    write_cells();
    write_point_data(solution);
    file_.write("<CellData>\n");
    write_boundary_numbers();
    if (blocks != nullptr) write_block_numbers(*blocks);
    if (solution != nullptr && solution->cells.width() > 0) write_cell_values(solution->cells);
    file_.write("</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    file_.close();
  }

 private:
  std::int64_t total(const auto& rows) const { return comm_.sum(std::ssize(rows)); }

  void write_head(const LoadedMesh* blocks) {
    const std::int64_t cells = total(mesh_.triangles) + total(mesh_.quads) + boundaries_.all_edges();
    std::vector<std::string> names;
    for (const BoundaryEdges* boundary : boundaries_.present()) names.push_back(boundary->name);
    std::string head =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
    head += "<UnstructuredGrid>\n<FieldData>\n" + vtu_text_array("boundary_names", names);
    if (blocks != nullptr) head += vtu_text_array("block_names", blocks->block_names);
    if (has_layers(mesh_)) head += layer_arrays();
    head += vtu_name_arrays(names, 1);
    head += "</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(comm_.sum(mesh_.owned_nodes)) +
            "\" NumberOfCells=\"" + std::to_string(cells) + "\">\n";
    file_.write(head);
  }

  /// Count and thickness of each boundary's layers.
  std::string layer_arrays() const {
    const auto tag = [&](const char* type, const char* name) {
      return std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" NumberOfTuples=\"" +
             std::to_string(boundaries_.present().size()) + "\" format=\"ascii\">\n";
    };
    TextRows counts(std::ssize(boundaries_.present()), 1), thicknesses(std::ssize(boundaries_.present()), 1);
    for (const BoundaryEdges* boundary : boundaries_.present()) {
      counts.put(boundary->layers.count, '\n');
      thicknesses.put(boundary->layers.thickness, '\n');
    }
    const std::vector<char> first = counts.take(), second = thicknesses.take();
    return tag("Int32", vtu_layer_counts) + std::string(first.begin(), first.end()) + "</DataArray>\n" +
           tag("Float64", vtu_layer_thicknesses) + std::string(second.begin(), second.end()) +
           "</DataArray>\n" + strip_array();
  }

  std::string strip_array() const {
    std::vector<std::string> texts;
    for (const StripLayers& strip : mesh_.strips) texts.push_back(comments_of(strip));
    return texts.empty() ? std::string() : vtu_text_array(vtu_strips, texts);
  }

  void write_points() {
    file_.write("<Points>\n" + array_tag("Float64", "Points", 3));
    file_.write_rows(mesh_.owned_nodes, 3, [&](TextRows& text, std::size_t i) {
      text.put(mesh_.points[i].x, ' ');
      text.put(mesh_.points[i].y, ' ');
      text.put(0, '\n');
    });
    file_.write("</DataArray>\n</Points>\n");
  }

  /// `visit(rows, type)` for each kind of cell; the boundaries' edges follow them.
  template <class Visit>
  void for_each_kind(const Visit& visit) const {
    visit(mesh_.triangles, int{vtk_triangle});
    visit(mesh_.quads, int{vtk_quad});
  }

  void write_cells() {
    file_.write("<Cells>\n" + array_tag("Int64", "connectivity"));
    for_each_kind([&](const auto& rows, int) {
      file_.write_rows(rows.size(), 4, [&](TextRows& text, std::size_t i) {
        for (std::size_t k = 0; k < rows[i].size(); ++k)
          text.put(mesh_.global(rows[i][k]).value(), k + 1 < rows[i].size() ? ' ' : '\n');
      });
    });
    file_.write_boundaries(
        boundaries_, 2, [](std::size_t) { return std::string(); },
        [](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) {
          text.put(edge[0], ' ');
          text.put(edge[1], '\n');
        });
    file_.write("</DataArray>\n" + array_tag("Int64", "offsets"));
    write_offsets();
    file_.write("</DataArray>\n" + array_tag("UInt8", "types"));
    for_each_kind([&](const auto& rows, int type) { write_repeated(rows.size(), type); });
    file_.write_root_rows(boundaries_.all_edges(), 1,
                          [](TextRows& text, std::size_t) { text.put(int{vtk_line}, '\n'); });
    file_.write("</DataArray>\n</Cells>\n");
  }

  void write_offsets() {
    std::int64_t before = 0;
    for_each_kind([&]<class Row>(const std::vector<Row>& rows, int) {
      constexpr std::int64_t width = std::tuple_size_v<Row>;
      const std::int64_t first = before + width * comm_.exclusive_sum(std::ssize(rows));
      file_.write_rows(rows.size(), 1,
                       [&](TextRows& text, std::int64_t i) { text.put(first + width * (i + 1), '\n'); });
      before += width * total(rows);
    });
    file_.write_root_rows(boundaries_.all_edges(), 1,
                          [&](TextRows& text, std::int64_t i) { text.put(before + 2 * (i + 1), '\n'); });
  }

  void write_repeated(std::size_t rows, std::int32_t number) {
    file_.write_rows(rows, 1, [&](TextRows& text, std::size_t) { text.put(number, '\n'); });
  }

  void write_point_data(const Field* solution) {
    const std::size_t width = solution == nullptr ? 0 : solution->names.size();
    if (width == 0 && !has_layers(mesh_)) return;
    file_.write("<PointData>\n");
    for (std::size_t k = 0; k < width; ++k)
      write_reals(solution->names[k], [&](std::size_t i) { return solution->values[i * width + k]; });
    if (has_layers(mesh_)) write_layer_heights();
    file_.write("</PointData>\n");
  }

  /// Of a value for each owned node.
  template <class Value>
  void write_reals(const std::string& name, const Value& value) {
    file_.write(array_tag("Float64", name));
    file_.write_rows(mesh_.owned_nodes, 1, [&](TextRows& text, std::size_t i) { text.put(value(i), '\n'); });
    file_.write("</DataArray>\n");
  }

  void write_layer_heights() {
    const LayerPlaces places = layer_places(comm_, mesh_);
    const IdVector<NodeId, double> heights = heights_to_front(comm_, mesh_, places);
    const auto at_wall = [&](std::size_t i) {
      return on_layered_wall(mesh_, places[NodeId{static_cast<std::int32_t>(i)}]);
    };
    write_reals(vtu_layer_height_asked, [&](std::size_t i) {
      return at_wall(i) ? layers_at(mesh_, places.begin()[i]).thickness : 0;
    });
    write_reals(vtu_layer_height, [&](std::size_t i) { return at_wall(i) ? heights.begin()[i] : 0; });
  }

  void write_boundary_numbers() {
    file_.write(array_tag("Int32", "boundary"));
    write_repeated(mesh_.triangles.size(), 0);
    write_repeated(mesh_.quads.size(), 0);
    std::size_t number = 0;  // rows come in their order
    std::int64_t end = 0;
    file_.write_root_rows(boundaries_.all_edges(), 1, [&](TextRows& text, std::int64_t i) {
      while (i >= end) end += boundaries_.edges_of(number++);
      text.put(number, '\n');
    });
    file_.write("</DataArray>\n");
  }

  void write_block_numbers(const LoadedMesh& whole) {
    file_.write(array_tag("Int32", "block"));
    for (const auto* cell_to_block : {&whole.triangle_to_block, &whole.quad_to_block}) {
      file_.write_rows(cell_to_block->size(), 1,
                       [&](TextRows& text, std::size_t i) { text.put((*cell_to_block)[i] + 1, '\n'); });
    }
    file_.write_root_rows(boundaries_.all_edges(), 1, [](TextRows& text, std::size_t) { text.put(0, '\n'); });
    file_.write("</DataArray>\n");
  }

  /// A boundary's line has the values of the cell beside it.
  void write_cell_values(const CellValues& cells) {
    const std::vector<std::int64_t> beside = edge_cells(comm_, mesh_).of_boundary;
    const std::size_t width = cells.width();
    const std::vector<double> at_lines = rows_of_cells(
        comm_, CellOwners(comm_, mesh_), std::span<const std::int64_t>(beside), cells.values, width);
    for (std::size_t k = 0; k < width; ++k) {
      file_.write(array_tag("Float64", cells.names[k]));
      std::size_t first = 0;
      for (const std::size_t rows : {mesh_.triangles.size(), mesh_.quads.size()}) {
        file_.write_rows(rows, 1, [&](TextRows& text, std::size_t i) {
          text.put(cells.values[(first + i) * width + k], '\n');
        });
        first += rows;
      }
      write_line_values(at_lines, width, k);
      file_.write("</DataArray>\n");
    }
  }

  /// They go the way of the edges' nodes, as their bits.
  void write_line_values(const std::vector<double>& at_lines, std::size_t width, std::size_t k) {
    std::vector<BoundaryStream::Edge> bits;
    for (std::size_t i = k; i < at_lines.size(); i += width)
      bits.push_back({std::bit_cast<std::int64_t>(at_lines[i]), 0});
    file_.write_boundaries(
        BoundaryStream(comm_, mesh_, std::move(bits)), 1, [](std::size_t) { return std::string(); },
        [](TextRows& text, std::size_t, const BoundaryStream::Edge& edge) {
          text.put(std::bit_cast<double>(edge[0]), '\n');
        });
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  TextOutput file_;
  BoundaryStream boundaries_;
};

}  // namespace

void write_vtu(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field* solution) {
  VtuWriter(outputs, mesh, path).write(nullptr, solution);
}

void write_vtu(OutputSet& outputs, const LoadedMesh& whole, const std::string& path) {
  VtuWriter(outputs, whole.mesh, path)
      .write(whole.blocks > 1 ? &whole : nullptr, whole.solution ? &*whole.solution : nullptr);
}

void write_vtu(const Communicator& comm, const Mesh& mesh, const std::string& path, const Field* solution) {
  OutputSet outputs(comm);
  write_vtu(outputs, mesh, path, solution);
  outputs.commit();
}

}  // namespace quadloop
