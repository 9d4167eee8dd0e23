#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "io/cgns/cgns_elements.hpp"
#include "io/cgns/cgns_file.hpp"
#include "io/cgns/cgns_names.hpp"
#include "io/cgns/cgns_patches.hpp"
#include "io/cgns/cgns_sink.hpp"
#include "io/model/pair_text.hpp"
#include "io/stream/mesh_stream.hpp"
#include "io/stream/stream_cell_values.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

/// Returns rows of an array type as one list of numbers.
template <class Number, std::size_t width>
std::span<const Number> flat(std::span<const std::array<Number, width>> rows) {
  return {rows.empty() ? nullptr : rows.front().data(), rows.size() * width};
}

class CgnsWriter {
 public:
  CgnsWriter(const MeshStream& stream, OutputSet& outputs, const std::string& path)
      : stream_{stream}, cells_{stream} {
    refuse_too_large(path);
    staged_ = outputs.stage(path);
    stream_.on_root([&] {
      sink_ = std::make_unique<CgnsSink>(staged_, stream_.is_plane() ? 2 : 3);
      sink_->begin_zone(stream_.counts().nodes, stream_.counts().cells());
    });
  }

  void write() {
    stream_.on_root([&] { sink_->begin_rows(); });
    stream_.is_plane() ? write_points<2>() : write_points<3>();
    for_each_kind([&]<CellKind kind>() { write_cells<kind>(); });
    if (!stream_.variables().empty()) write_solution();
    if (!cells_.names().empty()) write_solution_of_cells();
    write_boundaries();
  }

 private:
  template <std::size_t dimension>
  void write_points() {
    stream_.rows(
        stream_.point_rows(),
        [&](std::int64_t i) {
          const Point3 p = stream_.point(i);
          if constexpr (dimension == 2) return std::array{p.x, p.y};
          if constexpr (dimension == 3) return std::array{p.x, p.y, p.z};
        },
        [&](auto rows) { sink_->put_coordinates(flat<double>(rows)); });
  }

  void refuse_too_large(const std::string& path) const {
    const StreamCounts& counts = stream_.counts();
    std::int64_t elements = counts.cells();
    for (const StreamedPatch& patch : stream_.patches()) elements += patch.faces();
    if (elements <= largest_cgns_size && counts.largest_array() <= largest_cgns_size) return;
    throw OutputError(path + ": " + std::to_string(counts.nodes) + " nodes and " + std::to_string(elements) +
                      " elements are more than this CGNS library can count (32-bit sizes); write a " +
                      (stream_.is_plane() ? ".mesh" : ".vtu") + " file instead");
  }

  auto put() {
    return [this](auto faces) { patches_->put(flat<cgsize_t>(faces)); };
  }

  template <CellKind kind>
  void write_cells() {
    const std::int64_t all = stream_.counts().of(kind);
    if (all == 0) return;
    const ElementType_t type = cgns_type_of<kind>;
    stream_.on_root([&] { sink_->begin_section(cg_ElementTypeName(type), type, all); });
    stream_.rows(
        stream_.cell_rows<kind>(), [&](std::int64_t i) { return as<cgsize_t>(stream_.cell<kind>(i), 1); },
        [&](auto some) { sink_->put_elements(flat<cgsize_t>(some), cell_width<kind>); });
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
    for_each_kind([&]<CellKind kind>() {
      write_values(names, stream_.cell_rows<kind>(), [&](std::int64_t row, std::size_t variable) {
        return cells_.of_cell<kind>(row, variable);
      });
    });
  }

  void begin_solution(GridLocation_t location) {
    stream_.on_root([&] {
      sink_->begin_solution(location);
      sink_->begin_rows();
    });
  }

  /// Writes the next rows of all ranks in the current solution.
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

  /// Must be last: libcgns has closed the file.
  void write_boundaries() {
    stream_.on_root([&] {
      sink_->close();
      if (stream_.patches().empty()) return;
      patches_ = std::make_unique<CgnsPatches>(staged_, stream_.counts().cells() + 1);
    });
    if (stream_.patches().empty()) return;
    stream_.is_plane() ? write_edges() : write_patches();
    stream_.on_root([&] { patches_->close(); });
  }

  /// Names are assigned to all boundaries, including those without edges.
  void write_edges() {
    const std::vector<BoundaryEdges>& boundaries = stream_.extruded()->plane.boundaries;
    std::vector<std::string> names;
    for (const BoundaryEdges& boundary : boundaries) names.push_back(boundary.name);
    names = cgns_boundary_names(names);
    stream_.boundaries()->run(
        [&](std::size_t n) {
          const BoundaryEdges* const boundary = stream_.boundaries()->present()[n];
          const std::string& name = names[boundary - boundaries.data()];
          patches_->begin_patch();
          patches_->begin_section(name, BAR_2, stream_.patches()[n].edges);
          patches_->put_condition(name, *boundary, EdgeCenter);
        },
        [&](std::span<const BoundaryStream::Edge> edges) { patches_->put(edges); });
    const Mesh& mesh = stream_.extruded()->plane;
    stream_.on_root([&] { patches_->put_comments(comments_of(mesh)); });
    for (const PeriodicPair& pair : mesh.pairs) {
      const PairedNodes nodes = paired_nodes(stream_.communicator(), mesh, pair);
      const std::ptrdiff_t number = &pair - mesh.pairs.data() + 1;
      stream_.on_root([&] { patches_->put_pair("pair_" + std::to_string(number), pair, nodes); });
    }
  }

  void write_patches() {
    std::vector<std::string> wanted = stream_.patch_names();
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n)
      wanted.push_back(wanted[n] + "_triangles");
    names_ = cgns_boundary_names(wanted);
    stream_.sides([&](std::size_t n) { begin(n, 0, stream_.patches()[n].quads); }, number_nodes, put());
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) write_patch(n);
  }

  /// Begins a patch, on rank 0: its section of quads, then one of triangles.
  void begin(std::size_t patch, std::int64_t triangles, std::int64_t quads) {
    const StreamedPatch& about = stream_.patches()[patch];
    patches_->begin_patch();
    if (quads > 0) patches_->begin_section(names_[patch], QUAD_4, quads);
    if (triangles == 0) patches_->put_condition(names_[patch], {about.name, about.condition, {}}, FaceCenter);
  }

  /// Writes a patch that is not a side.
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

  const MeshStream& stream_;
  const StreamCellValues cells_;
  StagedFile staged_;
  /// Names of patches, then of the triangles of those that are not sides; this and the next two on rank 0
  /// only.
  std::vector<std::string> names_;
  std::unique_ptr<CgnsSink> sink_;
  std::unique_ptr<CgnsPatches> patches_;
};

}  // namespace

void write_cgns(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  CgnsWriter(mesh, outputs, path).write();
}

}  // namespace quadloop::io
