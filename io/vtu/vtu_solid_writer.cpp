#include <memory>

#include "io/files/binary_output.hpp"
#include "io/solid/solid_cell_values.hpp"
#include "io/solid/solid_stream.hpp"
#include "io/vtu/vtu_cell.hpp"
#include "io/vtu/vtu_solid_file.hpp"
#include "io/vtu/vtu_text.hpp"

namespace quadloop {

namespace {

/// In the order of VTK: of a wedge the first triangle looks outwards.
template <std::size_t width>
std::array<SolidNode, width> as_vtk(const std::array<SolidNode, width>& cell) {
  if constexpr (width == 6) return {cell[0], cell[2], cell[1], cell[3], cell[5], cell[4]};
  return cell;
}

template <std::size_t width>
constexpr std::uint8_t vtk_solid = width == 4   ? vtk_tetrahedron
                                   : width == 5 ? vtk_pyramid
                                   : width == 6 ? vtk_wedge
                                                : vtk_hexahedron;

/// Cells or faces of one type that follow each other in the file.
struct Run {
  std::uint8_t type;
  std::int64_t nodes;  ///< of each
  std::int64_t count;
  std::int32_t patch;  ///< from 1; 0: cells
};

class VtuSolidWriter {
 public:
  VtuSolidWriter(const SolidStream& stream, OutputSet& outputs, const std::string& path)
      : stream_{stream}, cells_{stream} {
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
    for (std::size_t k = 0; k < cells_.names().size(); ++k) write_cell_variable(k);
    for (std::size_t k = 0; k < stream_.variables().size(); ++k) write_variable(k);
    stream_.on_root([&] {
      file_->write("\n</AppendedData>\n</VTKFile>\n");
      file_->close();
    });
  }

 private:
  /// In the order of the file: cells, then of each patch its triangles and its quads.
  void list_runs() {
    for_each_kind_of_cell([&]<std::size_t width>() {
      runs_.push_back({vtk_solid<width>, width, stream_.all_cells<width>(), 0});
    });
    std::int32_t number = 0;
    for (const StreamedPatch& patch : stream_.patches()) {
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
        vtu_text_array("boundary_names", stream_.patch_names()) + vtu_name_arrays(stream_.patch_names(), 2) +
        "</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(nodes) + "\" NumberOfCells=\"" +
        std::to_string(elements_) + "\">\n<Points>\n";
    head += array_tag("Float64", "Points", 24 * nodes, 3);  // one after another: each moves the offset on
    head += "</Points>\n<Cells>\n" + array_tag("Int64", "connectivity", 8 * entries_);
    head += array_tag("Int64", "offsets", 8 * elements_);
    head += array_tag("UInt8", "types", elements_);
    head += "</Cells>\n<CellData>\n" + array_tag("Int32", "boundary", 4 * elements_);
    for (const std::string& name : cells_.names()) head += array_tag("Float64", name, 8 * elements_);
    head += "</CellData>\n";
    if (!stream_.variables().empty()) {
      head += "<PointData>\n";
      for (const std::string& name : stream_.variables()) head += array_tag("Float64", name, 8 * nodes);
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
    put_rows(stream_.point_rows(), [&](std::int64_t i) {
      const Point3 p = stream_.point(i);
      return std::array{p.x, p.y, p.z};
    });
  }

  void write_connectivity() {
    const auto make = [](const auto& nodes) { return in_order<std::endian::little>(nodes); };
    const auto write = [&](auto rows) { file_->write(bytes_of(rows)); };
    stream_.on_root([&] { begin_array(8 * entries_); });
    for_each_kind_of_cell([&]<std::size_t width>() {
      put_rows(stream_.cell_rows<width>(), [&](std::int64_t i) { return as_vtk(stream_.cell<width>(i)); });
    });
    stream_.sides([](std::size_t) {}, make, write);
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) {
      stream_.faces<3>(n, make, write);
      stream_.faces<4>(n, make, write);
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

  void write_variable(std::size_t variable) {
    stream_.on_root([&] { begin_array(8 * stream_.counts().nodes); });
    put_rows(stream_.point_rows(), [&](std::int64_t i) { return std::array{stream_.value(i, variable)}; });
  }

  /// Faces have the values of the cell beside them.
  void write_cell_variable(std::size_t variable) {
    stream_.on_root([&] { begin_array(8 * elements_); });
    for_each_kind_of_cell([&]<std::size_t width>() {
      put_rows(stream_.cell_rows<width>(),
               [&](std::int64_t i) { return std::array{cells_.of_cell<width>(i, variable)}; });
    });
    cells_.sides(variable, [&](std::span<const double> values) {
      for (const double value : values) put(std::array{value});
    });
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) {
      put_rows(stream_.face_rows<3>(n),
               [&](std::int64_t i) { return std::array{cells_.of_face<3>(n, i, variable)}; });
      put_rows(stream_.face_rows<4>(n),
               [&](std::int64_t i) { return std::array{cells_.of_face<4>(n, i, variable)}; });
    }
  }

  const SolidStream& stream_;
  const SolidCellValues cells_;
  std::vector<Run> runs_;
  std::int64_t elements_ = 0, entries_ = 0, offset_ = 0;
  std::unique_ptr<OutputFile> file_;  ///< on rank 0 only
};

}  // namespace

void write_vtu_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path) {
  VtuSolidWriter(mesh, outputs, path).write();
}

}  // namespace quadloop
