#include <memory>

#include "io/files/binary_output.hpp"
#include "io/solid/extruded_stream.hpp"
#include "io/vtu/vtu_cell.hpp"
#include "io/vtu/vtu_solid_file.hpp"
#include "io/vtu/vtu_text.hpp"

namespace quadloop {

namespace {

/// The wedge of VTK: its first triangle looks outwards.
std::array<SolidNode, 6> as_wedge(const std::array<SolidNode, 6>& prism) {
  return {prism[0], prism[2], prism[1], prism[3], prism[5], prism[4]};
}

/// Cells or faces of one type that follow each other in the file.
struct Run {
  std::uint8_t type;
  std::int64_t nodes;  ///< of each
  std::int64_t count;
  std::int32_t patch;  ///< from 1; 0: cells
};

class VtuSolidWriter {
 public:
  VtuSolidWriter(OutputSet& outputs, const ExtrudedMesh& mesh, const std::string& path)
      : stream_{outputs.communicator(), mesh} {
    if (mesh.solution != nullptr) variables_ = extruded_variables(*mesh.solution, mesh.axis);
    list_runs();
    const StagedFile staged = outputs.stage(path);
    stream_.on_root([&] {
      file_ = std::make_unique<OutputFile>(staged);
      write_head();
    });
  }

  void write() {
    write_points();
    write_connectivity();
    stream_.on_root([&] {
      write_offsets();
      write_of_runs<std::uint8_t>([](const Run& run) { return run.type; });
      write_of_runs<std::int32_t>([](const Run& run) { return run.patch; });
    });
    for (const ExtrudedVariable& variable : variables_) write_variable(variable);
    stream_.on_root([&] {
      file_->write("\n</AppendedData>\n</VTKFile>\n");
      file_->close();
    });
  }

 private:
  /// In the order of the file: cells, then of each patch its triangles and its quads.
  void list_runs() {
    const ExtrudedCounts& counts = stream_.counts();
    runs_ = {{vtk_wedge, 6, counts.prisms, 0}, {vtk_hexahedron, 8, counts.hexahedra, 0}};
    std::int32_t number = 0;
    for (const ExtrudedPatch& patch : stream_.patches()) {
      ++number;
      runs_.push_back({vtk_triangle, 3, patch.triangles, number});
      runs_.push_back({vtk_quad, 4, patch.quads, number});
    }
    for (const Run& run : runs_) {
      elements_ += run.count;
      entries_ += run.count * run.nodes;
    }
  }

  /// The tag of an array of so many bytes in the appended data, each after its size.
  std::string array_tag(const std::string& type, const std::string& name, std::int64_t bytes,
                        int components = 1) {
    std::string tag = "<DataArray type=\"" + type + "\" Name=\"" + xml_escaped(name) + "\"";
    if (components > 1) tag += " NumberOfComponents=\"" + std::to_string(components) + "\"";
    tag += " format=\"appended\" offset=\"" + std::to_string(offset_) + "\"/>\n";
    offset_ += bytes + std::int64_t{sizeof(std::uint64_t)};
    return tag;
  }

  void write_head() {
    const std::int64_t nodes = stream_.counts().nodes;
    std::string head =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n" +
        vtu_text_array("boundary_names", stream_.patch_names()) + "</FieldData>\n<Piece NumberOfPoints=\"" +
        std::to_string(nodes) + "\" NumberOfCells=\"" + std::to_string(elements_) + "\">\n<Points>\n";
    head += array_tag("Float64", "Points", 24 * nodes, 3);  // one after another: each moves the offset on
    head += "</Points>\n<Cells>\n" + array_tag("Int64", "connectivity", 8 * entries_);
    head += array_tag("Int64", "offsets", 8 * elements_);
    head += array_tag("UInt8", "types", elements_);
    head += "</Cells>\n<CellData>\n" + array_tag("Int32", "boundary", 4 * elements_) + "</CellData>\n";
    if (!variables_.empty()) {
      head += "<PointData>\n";
      for (const ExtrudedVariable& variable : variables_)
        head += array_tag("Float64", variable.name, 8 * nodes);
      head += "</PointData>\n";
    }
    file_->write(head + "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_");
  }

  /// On rank 0.
  void begin_array(std::int64_t bytes) { put(std::array{static_cast<std::uint64_t>(bytes)}); }
  template <class Number, std::size_t width>
  void put(const std::array<Number, width>& numbers) {
    const auto bytes = in_order<std::endian::little>(numbers);
    file_->write(bytes_of(std::span<const Number>(bytes)));
  }

  template <class Make>
  void put_rows(std::int64_t rows, const Make& make) {
    stream_.rows(
        rows, [&](std::int64_t i) { return in_order<std::endian::little>(make(i)); },
        [&](auto some) { file_->write(bytes_of(some)); });
  }

  void write_points() {
    stream_.on_root([&] { begin_array(24 * stream_.counts().nodes); });
    put_rows(stream_.mesh().point_rows(), [&](std::int64_t i) {
      const Point3 p = stream_.mesh().point(i);
      return std::array{p.x, p.y, p.z};
    });
  }

  void write_connectivity() {
    const ExtrudedMesh& mesh = stream_.mesh();
    const auto make = [](const auto& nodes) { return in_order<std::endian::little>(nodes); };
    const auto write = [&](auto rows) { file_->write(bytes_of(rows)); };
    stream_.on_root([&] { begin_array(8 * entries_); });
    put_rows(mesh.prism_rows(), [&](std::int64_t i) { return as_wedge(mesh.prism(i)); });
    put_rows(mesh.hexahedron_rows(), [&](std::int64_t i) { return mesh.hexahedron(i); });
    stream_.sides([](std::size_t) {}, make, write);
    for (const bool front : {false, true}) {
      stream_.end(mesh.plane.triangles, front, make, write);
      stream_.end(mesh.plane.quads, front, make, write);
    }
  }

  void write_offsets() {
    begin_array(8 * elements_);
    std::int64_t end = 0;
    write_numbers<std::int64_t>([&](const Run& run) { return end += run.nodes; });
  }

  template <class Number, class Value>
  void write_of_runs(const Value& value) {
    begin_array(elements_ * std::int64_t{sizeof(Number)});
    write_numbers<Number>(value);
  }

  /// One for each cell and face, in bounded pieces.
  template <class Number, class Value>
  void write_numbers(const Value& value) {
    constexpr std::size_t most = std::size_t{1} << 17;
    std::vector<Number> numbers;
    const auto flush = [&] {
      file_->write(bytes_of(std::span<const Number>(numbers)));
      numbers.clear();
    };
    for (const Run& run : runs_) {
      for (std::int64_t i = 0; i < run.count; ++i) {
        numbers.push_back(in_order<std::endian::little>(Number{value(run)}));
        if (numbers.size() == most) flush();
      }
    }
    flush();
  }

  void write_variable(const ExtrudedVariable& variable) {
    const ExtrudedMesh& mesh = stream_.mesh();
    const std::size_t width = mesh.solution->width();
    stream_.on_root([&] { begin_array(8 * stream_.counts().nodes); });
    put_rows(mesh.point_rows(), [&](std::int64_t i) {
      const bool zero = variable.column == ExtrudedVariable::zero;
      return std::array{zero ? 0.0 : mesh.solution->values[i / mesh.levels() * width + variable.column]};
    });
  }

  ExtrudedStream stream_;
  std::vector<ExtrudedVariable> variables_;
  std::vector<Run> runs_;
  std::int64_t elements_ = 0, entries_ = 0, offset_ = 0;
  std::unique_ptr<OutputFile> file_;  ///< on rank 0 only
};

}  // namespace

void write_vtu_solid(OutputSet& outputs, const ExtrudedMesh& mesh, const std::string& path) {
  VtuSolidWriter(outputs, mesh, path).write();
}

}  // namespace quadloop
