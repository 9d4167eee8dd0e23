#include "io/solid/solid_blocks.hpp"
#include "io/solid/solid_cell_values.hpp"
#include "io/solid/solid_stream.hpp"
#include "io/solid/vtk_cell.hpp"
#include "io/vtu/vtu_appended.hpp"
#include "io/vtu/vtu_file.hpp"
#include "io/vtu/vtu_text.hpp"

namespace quadloop {

namespace {

/// In the order of VTK.
template <std::size_t width>
std::array<SolidNode, width> as_vtk(const std::array<SolidNode, width>& cell) {
  if constexpr (width == 6) return vtk_wedge_order(cell);
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
      : stream_{stream}, cells_{stream}, blocks_{stream}, file_{outputs, path} {
    list_runs();
  }

  void write() {
    add_points();
    add_cells();
    for (std::size_t k = 0; k < cells_.names().size(); ++k)
      file_.add<double>("CellData", cells_.names()[k], 1, elements_, [this, k] { put_cell_variable(k); });
    for (std::size_t k = 0; k < stream_.variables().size(); ++k)
      file_.add<double>("PointData", stream_.variables()[k], 1, stream_.counts().nodes, [this, k] {
        file_.put_rows(stream_.point_rows(), [&](std::int64_t i) { return std::array{stream_.value(i, k)}; });
      });
    file_.write(head());
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

  std::string head() const {
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
           "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n" +
           vtu_text_array("boundary_names", stream_.patch_names()) +
           (blocks_.several() ? vtu_text_array("block_names", blocks_.names()) : "") +
           vtu_name_arrays(stream_.patch_names(), 2) + "</FieldData>\n<Piece NumberOfPoints=\"" +
           std::to_string(stream_.counts().nodes) + "\" NumberOfCells=\"" + std::to_string(elements_) +
           "\">\n";
  }

  void add_points() {
    file_.add<double>("Points", "Points", 3, stream_.counts().nodes, [this] {
      file_.put_rows(stream_.point_rows(), [&](std::int64_t i) {
        const Point3 p = stream_.point(i);
        return std::array{p.x, p.y, p.z};
      });
    });
  }

  void add_cells() {
    file_.add<std::int64_t>("Cells", "connectivity", 1, entries_, [this] { put_connectivity(); });
    file_.add<std::int64_t>("Cells", "offsets", 1, elements_, [this] {
      std::int64_t end = 0;
      put_of_runs<std::int64_t>([&](const Run& run) { return end += run.nodes; });
    });
    file_.add<std::uint8_t>("Cells", "types", 1, elements_,
                            [this] { put_of_runs<std::uint8_t>([](const Run& run) { return run.type; }); });
    file_.add<std::int32_t>("CellData", "boundary", 1, elements_,
                            [this] { put_of_runs<std::int32_t>([](const Run& run) { return run.patch; }); });
    if (blocks_.several())
      file_.add<std::int32_t>("CellData", "block", 1, elements_, [this] { put_blocks(); });
  }

  /// Of cells from 1; 0 of the faces of patches, which come last.
  void put_blocks() {
    for_each_kind_of_cell([&]<std::size_t width>() {
      file_.put_rows(stream_.cell_rows<width>(),
                     [&](std::int64_t i) { return std::array{blocks_.of<width>(i) + 1}; });
    });
    stream_.on_root([&] {
      Gathered<std::int32_t> none(file_);
      for (std::int64_t i = stream_.counts().cells(); i < elements_; ++i) none.add(0);
      none.flush();
    });
  }

  void put_connectivity() {
    const auto make = [](const auto& nodes) { return in_order<std::endian::little>(nodes); };
    const auto put = [this](auto rows) { file_.put(rows); };
    for_each_kind_of_cell([&]<std::size_t width>() {
      file_.put_rows(stream_.cell_rows<width>(),
                     [&](std::int64_t i) { return as_vtk(stream_.cell<width>(i)); });
    });
    stream_.sides([](std::size_t) {}, make, put);
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) {
      stream_.faces<3>(n, make, put);
      stream_.faces<4>(n, make, put);
    }
  }

  /// One for each cell and face, in bounded pieces.
  template <class Number, class Value>
  void put_of_runs(const Value& value) {
    stream_.on_root([&] {
      Gathered<Number> numbers(file_);
      for (const Run& run : runs_) {
        for (std::int64_t i = 0; i < run.count; ++i) numbers.add(Number{value(run)});
      }
      numbers.flush();
    });
  }

  /// Numbers that rank 0 makes one by one.
  template <class Number>
  class Gathered {
   public:
    explicit Gathered(VtuAppended& file) : file_{file} {}
    void add(Number number) {
      numbers_.push_back(in_order<std::endian::little>(number));
      if (numbers_.size() == most) flush();
    }
    void flush() {
      file_.put(std::span<const Number>(numbers_));
      numbers_.clear();
    }

   private:
    static constexpr std::size_t most = std::size_t{1} << 17;
    VtuAppended& file_;
    std::vector<Number> numbers_;
  };

  /// Faces have the values of the cell beside them.
  void put_cell_variable(std::size_t variable) {
    for_each_kind_of_cell([&]<std::size_t width>() {
      file_.put_rows(stream_.cell_rows<width>(),
                     [&](std::int64_t i) { return std::array{cells_.of_cell<width>(i, variable)}; });
    });
    Gathered<double> at_sides(file_);
    cells_.sides(variable, [&](std::span<const double> values) {
      for (const double value : values) at_sides.add(value);
    });
    stream_.on_root([&] { at_sides.flush(); });
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) {
      file_.put_rows(stream_.face_rows<3>(n),
                     [&](std::int64_t i) { return std::array{cells_.of_face<3>(n, i, variable)}; });
      file_.put_rows(stream_.face_rows<4>(n),
                     [&](std::int64_t i) { return std::array{cells_.of_face<4>(n, i, variable)}; });
    }
  }

  const SolidStream& stream_;
  const SolidCellValues cells_;
  const SolidBlocks blocks_;
  VtuAppended file_;
  std::vector<Run> runs_;
  std::int64_t elements_ = 0, entries_ = 0;
};

}  // namespace

void write_vtu_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path) {
  VtuSolidWriter(mesh, outputs, path).write();
}

}  // namespace quadloop
