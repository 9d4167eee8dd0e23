#include <bit>
#include <span>

#include "io/model/strip_text.hpp"
#include "io/solid/vtk_cell.hpp"
#include "io/text/text_output.hpp"
#include "io/vtu/vtu_appended.hpp"
#include "io/vtu/vtu_file.hpp"
#include "io/vtu/vtu_layers.hpp"
#include "io/vtu/vtu_text.hpp"
#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/cells/edge_cells.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop {

namespace {

class VtuWriter {
 public:
  VtuWriter(OutputSet& outputs, const Mesh& mesh, const std::string& path)
      : comm_{outputs.communicator()}, mesh_{mesh}, file_{outputs, path}, boundaries_{comm_, mesh} {
    triangles_ = comm_.sum(std::ssize(mesh.triangles));
    quads_ = comm_.sum(std::ssize(mesh.quads));
    nodes_ = comm_.sum(mesh.owned_nodes);
    elements_ = triangles_ + quads_ + boundaries_.all_edges();
  }

  void write(const LoadedMesh* blocks, const Field* solution) {
    add_points();
    add_cells();
    if (solution != nullptr) add_solution(*solution);
    if (has_layers(mesh_)) add_layer_heights();
    add_boundary_numbers();
    if (blocks != nullptr) add_block_numbers(*blocks);
    if (solution != nullptr && solution->cells.width() > 0) add_cell_values(solution->cells);
    file_.write(head(blocks));
  }

 private:
  std::string head(const LoadedMesh* blocks) const {
    std::vector<std::string> names;
    for (const BoundaryEdges* boundary : boundaries_.present()) names.push_back(boundary->name);
    std::string head =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n";
    head += "<UnstructuredGrid>\n<FieldData>\n" + vtu_text_array("boundary_names", names);
    if (blocks != nullptr) head += vtu_text_array("block_names", blocks->block_names);
    if (has_layers(mesh_)) head += layer_arrays();
    head += vtu_name_arrays(names, 1);
    return head + "</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(nodes_) + "\" NumberOfCells=\"" +
           std::to_string(elements_) + "\">\n";
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

  void add_points() {
    file_.add<double>("Points", "Points", 3, nodes_, [this] {
      file_.put_rows(mesh_.owned_nodes, [&](std::int64_t i) {
        return std::array{mesh_.points[i].x, mesh_.points[i].y, 0.0};
      });
    });
  }

  void add_cells() {
    const std::int64_t entries = 3 * triangles_ + 4 * quads_ + 2 * boundaries_.all_edges();
    file_.add<std::int64_t>("Cells", "connectivity", 1, entries, [this] {
      put_nodes(mesh_.triangles);
      put_nodes(mesh_.quads);
      file_.put_edges(boundaries_, [](const BoundaryStream::Edge& edge) { return edge; });
    });
    file_.add<std::int64_t>("Cells", "offsets", 1, elements_, [this] { put_offsets(); });
    file_.add<std::uint8_t>("Cells", "types", 1, elements_, [this] {
      put_of_kinds<std::uint8_t>(vtk_triangle, vtk_quad);
      put_of_lines([](std::int64_t) { return std::uint8_t{vtk_line}; });
    });
  }

  template <std::size_t width>
  void put_nodes(const std::vector<std::array<NodeId, width>>& cells) {
    file_.put_rows(std::ssize(cells), [&](std::int64_t i) {
      std::array<std::int64_t, width> nodes;
      for (std::size_t k = 0; k < width; ++k) nodes[k] = mesh_.global(cells[i][k]).value();
      return nodes;
    });
  }

  /// Where each element's nodes end.
  void put_offsets() {
    std::int64_t before = 0;
    const auto put = [&]<std::size_t width>(const std::vector<std::array<NodeId, width>>& cells) {
      constexpr std::int64_t nodes = width;
      const std::int64_t first = before + nodes * comm_.exclusive_sum(std::ssize(cells));
      file_.put_rows(std::ssize(cells), [&](std::int64_t i) { return std::array{first + nodes * (i + 1)}; });
    };
    put(mesh_.triangles);
    before += 3 * triangles_;
    put(mesh_.quads);
    before += 4 * quads_;
    put_of_lines([&](std::int64_t i) { return before + 2 * (i + 1); });
  }

  /// One number for every triangle, another for every quad.
  template <class Number>
  void put_of_kinds(Number of_triangle, Number of_quad) {
    file_.put_rows(std::ssize(mesh_.triangles), [&](std::int64_t) { return std::array{of_triangle}; });
    file_.put_rows(std::ssize(mesh_.quads), [&](std::int64_t) { return std::array{of_quad}; });
  }
  /// `value(i)` for line i of all, made on rank 0.
  template <class Value>
  void put_of_lines(const Value& value) {
    file_.put_root_rows(boundaries_.all_edges(), [&](std::int64_t i) { return std::array{value(i)}; });
  }

  void add_solution(const Field& solution) {
    const std::size_t width = solution.names.size();
    for (std::size_t k = 0; k < width; ++k)
      add_of_nodes(solution.names[k],
                   [&solution, width, k](std::int64_t i) { return solution.values[i * width + k]; });
  }

  /// Of a value for each owned node.
  template <class Value>
  void add_of_nodes(const std::string& name, Value value) {
    file_.add<double>("PointData", name, 1, nodes_, [this, value] {
      file_.put_rows(mesh_.owned_nodes, [&](std::int64_t i) { return std::array<double, 1>{value(i)}; });
    });
  }

  void add_layer_heights() {
    places_ = layer_places(comm_, mesh_);
    heights_ = heights_to_front(comm_, mesh_, places_);
    const auto at_wall = [this](std::int64_t i) { return on_layered_wall(mesh_, places_.begin()[i]); };
    add_of_nodes(vtu_layer_height_asked, [this, at_wall](std::int64_t i) {
      return at_wall(i) ? layers_at(mesh_, places_.begin()[i]).thickness : 0;
    });
    add_of_nodes(vtu_layer_height,
                 [this, at_wall](std::int64_t i) { return at_wall(i) ? heights_.begin()[i] : 0; });
  }

  void add_boundary_numbers() {
    file_.add<std::int32_t>("CellData", "boundary", 1, elements_, [this] {
      put_of_kinds<std::int32_t>(0, 0);
      std::int32_t number = 0;  // rows come in their order
      std::int64_t end = 0;
      put_of_lines([&](std::int64_t i) {
        while (i >= end) end += boundaries_.edges_of(number++);
        return number;
      });
    });
  }

  void add_block_numbers(const LoadedMesh& whole) {
    file_.add<std::int32_t>("CellData", "block", 1, elements_, [this, &whole] {
      for (const auto* cell_to_block : {&whole.triangle_to_block, &whole.quad_to_block}) {
        file_.put_rows(std::ssize(*cell_to_block),
                       [&](std::int64_t i) { return std::array{(*cell_to_block)[i] + 1}; });
      }
      put_of_lines([](std::int64_t) { return std::int32_t{0}; });
    });
  }

  /// A boundary's line has the values of the cell beside it.
  void add_cell_values(const CellValues& cells) {
    const std::vector<std::int64_t> beside = edge_cells(comm_, mesh_).of_boundary;
    const std::size_t width = cells.width();
    at_lines_ = rows_of_cells(comm_, CellOwners(comm_, mesh_), std::span<const std::int64_t>(beside),
                              cells.values, width);
    for (std::size_t k = 0; k < width; ++k) {
      file_.add<double>("CellData", cells.names[k], 1, elements_, [this, &cells, width, k] {
        std::int64_t first = 0;
        for (const std::int64_t rows : {std::ssize(mesh_.triangles), std::ssize(mesh_.quads)}) {
          file_.put_rows(rows,
                         [&](std::int64_t i) { return std::array{cells.values[(first + i) * width + k]}; });
          first += rows;
        }
        put_line_values(width, k);
      });
    }
  }

  /// They go the way of the edges' nodes, as their bits.
  void put_line_values(std::size_t width, std::size_t k) {
    std::vector<BoundaryStream::Edge> bits;
    for (std::size_t i = k; i < at_lines_.size(); i += width)
      bits.push_back({std::bit_cast<std::int64_t>(at_lines_[i]), 0});
    file_.put_edges(BoundaryStream(comm_, mesh_, std::move(bits)), [](const BoundaryStream::Edge& edge) {
      return std::array{std::bit_cast<double>(edge[0])};
    });
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  VtuAppended file_;
  BoundaryStream boundaries_;
  std::int64_t nodes_ = 0, triangles_ = 0, quads_ = 0;
  std::int64_t elements_ = 0;  ///< with the boundaries' lines
  LayerPlaces places_;
  IdVector<NodeId, double> heights_;
  std::vector<double> at_lines_;  ///< cell values beside this rank's boundary edges
};

}  // namespace

void write_vtu(OutputSet& outputs, const Mesh& mesh, const std::string& path, const Field* solution) {
  VtuWriter(outputs, mesh, path).write(nullptr, solution);
}

void write_vtu(OutputSet& outputs, const LoadedMesh& whole, const std::string& path) {
  VtuWriter(outputs, whole.mesh, path)
      .write(has_named_blocks(whole) ? &whole : nullptr, whole.solution ? &*whole.solution : nullptr);
}

void write_vtu(const Communicator& comm, const Mesh& mesh, const std::string& path, const Field* solution) {
  OutputSet outputs(comm);
  write_vtu(outputs, mesh, path, solution);
  outputs.commit();
}

}  // namespace quadloop
