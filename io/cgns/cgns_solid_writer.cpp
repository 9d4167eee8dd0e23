#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "io/cgns/cgns_names.hpp"
#include "io/cgns/cgns_patches.hpp"
#include "io/cgns/cgns_sink.hpp"
#include "io/cgns/cgns_solid_file.hpp"
#include "io/solid/solid_cell_values.hpp"
#include "io/solid/solid_stream.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

/// Rows of an array type as one list of numbers.
template <class Number, std::size_t width>
std::span<const Number> flat(std::span<const std::array<Number, width>> rows) {
  return {rows.empty() ? nullptr : rows.front().data(), rows.size() * width};
}

class CgnsSolidWriter {
 public:
  CgnsSolidWriter(const SolidStream& stream, OutputSet& outputs, const std::string& path)
      : stream_{stream}, cells_{stream} {
    refuse_too_large(path);
    staged_ = outputs.stage(path);
    stream_.on_root([&] {
      sink_ = std::make_unique<CgnsSink>(staged_, 3);
      sink_->begin_zone(stream_.counts().nodes, stream_.counts().cells());
    });
  }

  void write() {
    stream_.on_root([&] { sink_->begin_rows(); });
    stream_.rows(
        stream_.point_rows(),
        [&](std::int64_t i) {
          const Point3 p = stream_.point(i);
          return std::array{p.x, p.y, p.z};
        },
        [&](auto rows) { sink_->put_coordinates(flat<double>(rows)); });
    for_each_kind_of_cell([&]<std::size_t width>() { write_cells<width>(); });
    if (!stream_.variables().empty()) write_solution();
    if (!cells_.names().empty()) write_solution_of_cells();
    write_patches();
  }

 private:
  void refuse_too_large(const std::string& path) const {
    const SolidCounts& counts = stream_.counts();
    const std::int64_t elements = counts.cells() + stream_.patch_triangles() + stream_.patch_quads();
    if (elements <= largest_cgns_size && counts.largest_array() <= largest_cgns_size) return;
    throw OutputError(path + ": " + std::to_string(counts.nodes) + " nodes and " + std::to_string(elements) +
                      " elements are more than this CGNS library can count (32-bit sizes); write a .vtu file "
                      "instead");
  }

  auto put() {
    return [this](auto faces) { patches_->put(flat<cgsize_t>(faces)); };
  }

  template <std::size_t width>
  static constexpr ElementType_t type_of_cells = width == 4   ? TETRA_4
                                                 : width == 5 ? PYRA_5
                                                 : width == 6 ? PENTA_6
                                                              : HEXA_8;

  template <std::size_t width>
  void write_cells() {
    const std::int64_t all = stream_.all_cells<width>();
    if (all == 0) return;
    const ElementType_t type = type_of_cells<width>;
    stream_.on_root([&] { sink_->begin_section(cg_ElementTypeName(type), type, all); });
    stream_.rows(
        stream_.cell_rows<width>(), [&](std::int64_t i) { return as<cgsize_t>(stream_.cell<width>(i), 1); },
        [&](auto some) { sink_->put_elements(flat<cgsize_t>(some), width); });
  }

  void write_solution() {
    const std::vector<std::string> names = stream_.variables();
    begin_solution(Vertex);
    write_values(names, stream_.point_rows(),
                 [&](std::int64_t row, std::size_t variable) { return stream_.value(row, variable); });
  }

  /// In the order of the elements.
  void write_solution_of_cells() {
    const std::vector<std::string> names = cells_.names();
    begin_solution(CellCenter);
    for_each_kind_of_cell([&]<std::size_t width>() {
      write_values(names, stream_.cell_rows<width>(), [&](std::int64_t row, std::size_t variable) {
        return cells_.of_cell<width>(row, variable);
      });
    });
  }

  void begin_solution(GridLocation_t location) {
    stream_.on_root([&] {
      sink_->begin_solution(location);
      sink_->begin_rows();
    });
  }

  /// The ranks' next rows of the solution under way.
  template <class Value>
  void write_values(const std::vector<std::string>& names, std::int64_t count, const Value& value) {
    const std::size_t wide = names.size();
    const RowStream rows{stream_.communicator(), count,
                         std::max<std::int64_t>(1, numbers_per_piece / static_cast<std::int64_t>(wide))};
    rows.run<double>(
        [&](std::int64_t begin, std::int64_t end) {
          std::vector<double> values;
          values.reserve((end - begin) * wide);
          for (std::int64_t i = begin; i < end; ++i) {
            for (std::size_t k = 0; k < wide; ++k) values.push_back(value(i, k));
          }
          return values;
        },
        [&](std::span<const double> values) { sink_->put_solution(values, names); });
  }

  /// Last of all: libcgns is done with the file.
  void write_patches() {
    stream_.on_root([&] {
      sink_->close();
      patches_ = std::make_unique<CgnsPatches>(staged_, stream_.counts().cells() + 1);
      std::vector<std::string> wanted = stream_.patch_names();
      for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n)
        wanted.push_back(wanted[n] + "_triangles");
      names_ = cgns_boundary_names(wanted);
    });
    stream_.sides([&](std::size_t n) { begin(n, 0, stream_.patches()[n].quads); }, number_nodes, put());
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) write_patch(n);
    stream_.on_root([&] { patches_->close(); });
  }

  /// A patch, on rank 0: its section of quads, after it one of triangles.
  void begin(std::size_t patch, std::int64_t triangles, std::int64_t quads) {
    const StreamedPatch& about = stream_.patches()[patch];
    patches_->begin_patch();
    if (quads > 0) patches_->begin_section(names_[patch], QUAD_4, quads);
    if (triangles == 0) patches_->put_condition(names_[patch], {about.name, about.condition, {}}, FaceCenter);
  }

  /// One that is none of the sides.
  void write_patch(std::size_t patch) {
    const StreamedPatch& about = stream_.patches()[patch];
    if (about.faces() == 0) return;
    stream_.on_root([&] { begin(patch, about.triangles, about.quads); });
    if (about.quads > 0) stream_.faces<4>(patch, number_nodes, put());
    if (about.triangles == 0) return;
    const std::size_t more = stream_.patches().size() - stream_.side_patches();
    stream_.on_root([&] {
      patches_->begin_section(names_[patch + (about.quads > 0 ? more : 0)], TRI_3, about.triangles);
      patches_->put_condition(names_[patch], {about.name, about.condition, {}}, FaceCenter);
    });
    stream_.faces<3>(patch, number_nodes, put());
  }

  static constexpr auto number_nodes = [](const auto& nodes) { return as<cgsize_t>(nodes, 1); };
  static constexpr std::int64_t numbers_per_piece = std::int64_t{1} << 17;

  const SolidStream& stream_;
  const SolidCellValues cells_;
  StagedFile staged_;
  std::vector<std::string>
      names_;  ///< of patches, then of the triangles of those that are no sides; these three on rank 0 only
  std::unique_ptr<CgnsSink> sink_;
  std::unique_ptr<CgnsPatches> patches_;
};

}  // namespace

void write_cgns_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path) {
  CgnsSolidWriter(mesh, outputs, path).write();
}

}  // namespace quadloop
