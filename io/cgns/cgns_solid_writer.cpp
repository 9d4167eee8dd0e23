#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <tuple>

#include "io/cgns/cgns_names.hpp"
#include "io/cgns/cgns_patches.hpp"
#include "io/cgns/cgns_sink.hpp"
#include "io/cgns/cgns_solid_file.hpp"
#include "io/solid/extruded_stream.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr std::int64_t largest_size = std::numeric_limits<cgsize_t>::max();

/// Rows of an array type as one list of numbers.
template <class Number, std::size_t width>
std::span<const Number> flat(std::span<const std::array<Number, width>> rows) {
  return {rows.empty() ? nullptr : rows.front().data(), rows.size() * width};
}

class CgnsSolidWriter {
 public:
  CgnsSolidWriter(OutputSet& outputs, const ExtrudedMesh& mesh, const std::string& path)
      : stream_{outputs.communicator(), mesh}, mesh_{mesh} {
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
        mesh_.point_rows(),
        [&](std::int64_t i) {
          const Point3 p = mesh_.point(i);
          return std::array{p.x, p.y, p.z};
        },
        [&](auto rows) { sink_->put_coordinates(flat<double>(rows)); });
    write_cells("PENTA_6", PENTA_6, mesh_.prism_rows(), stream_.counts().prisms,
                [&](std::int64_t i) { return mesh_.prism(i); });
    write_cells("HEXA_8", HEXA_8, mesh_.hexahedron_rows(), stream_.counts().hexahedra,
                [&](std::int64_t i) { return mesh_.hexahedron(i); });
    if (mesh_.solution != nullptr) write_solution();
    write_patches();
  }

 private:
  void refuse_too_large(const std::string& path) const {
    const ExtrudedCounts& counts = stream_.counts();
    const std::int64_t elements = counts.cells() + stream_.patch_triangles() + stream_.patch_quads();
    if (counts.nodes <= largest_size && elements <= largest_size && 6 * counts.prisms <= largest_size &&
        8 * counts.hexahedra <= largest_size)
      return;
    throw OutputError(path + ": " + std::to_string(counts.nodes) + " nodes and " + std::to_string(elements) +
                      " elements are more than this CGNS library can count (32-bit sizes); write a .vtu file "
                      "instead");
  }

  auto put() {
    return [this](auto faces) { patches_->put(flat<cgsize_t>(faces)); };
  }

  template <class Nodes>
  void write_cells(const std::string& name, ElementType_t type, std::int64_t rows, std::int64_t all,
                   const Nodes& nodes) {
    if (all == 0) return;
    stream_.on_root([&] { sink_->begin_section(name, type, all); });
    stream_.rows(
        rows, [&](std::int64_t i) { return as<cgsize_t>(nodes(i), 1); },
        [&](auto some) {
          sink_->put_elements(flat<cgsize_t>(some), std::tuple_size_v<typename decltype(some)::value_type>);
        });
  }

  void write_solution() {
    const std::vector<ExtrudedVariable> variables = extruded_variables(*mesh_.solution, mesh_.axis);
    if (variables.empty()) return;
    std::vector<std::string> names;
    for (const ExtrudedVariable& variable : variables) names.push_back(variable.name);
    names = cgns_variable_names(names);
    const std::size_t width = mesh_.solution->width(), wide = variables.size();
    stream_.on_root([&] {
      sink_->begin_solution();
      sink_->begin_rows();
    });
    const RowStream rows{stream_.communicator(), mesh_.point_rows(),
                         std::max<std::int64_t>(1, numbers_per_piece / static_cast<std::int64_t>(wide))};
    rows.run<double>(
        [&](std::int64_t begin, std::int64_t end) {
          std::vector<double> values;
          values.reserve((end - begin) * wide);
          for (std::int64_t i = begin; i < end; ++i) {
            for (const auto& [name, column] : variables)
              values.push_back(column == ExtrudedVariable::zero
                                   ? 0
                                   : mesh_.solution->values[i / mesh_.levels() * width + column]);
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
      for (const std::string& end : {mesh_.back, mesh_.front}) wanted.push_back(end + "_triangles");
      names_ = cgns_boundary_names(wanted);
    });
    stream_.sides([&](std::size_t n) { begin(n, 0, stream_.patches()[n].quads); }, number_nodes, put());
    for (const bool front : {false, true}) write_end(front);
    stream_.on_root([&] { patches_->close(); });
  }

  /// A patch, on rank 0: its section of quads, after it one of triangles.
  void begin(std::size_t patch, std::int64_t triangles, std::int64_t quads) {
    const ExtrudedPatch& about = stream_.patches()[patch];
    patches_->begin_patch();
    if (quads > 0) patches_->begin_section(names_[patch], QUAD_4, quads);
    if (triangles == 0) patches_->put_condition(names_[patch], {about.name, about.condition, {}}, FaceCenter);
  }

  void write_end(bool front) {
    const std::size_t patch = stream_.sides() + (front ? 1 : 0);
    const ExtrudedPatch& about = stream_.patches()[patch];
    stream_.on_root([&] { begin(patch, about.triangles, about.quads); });
    if (about.quads > 0) stream_.end(mesh_.plane.quads, front, number_nodes, put());
    if (about.triangles == 0) return;
    stream_.on_root([&] {
      patches_->begin_section(about.quads > 0 ? names_[patch + 2] : names_[patch], TRI_3, about.triangles);
      patches_->put_condition(names_[patch], {about.name, about.condition, {}}, FaceCenter);
    });
    stream_.end(mesh_.plane.triangles, front, number_nodes, put());
  }

  static constexpr auto number_nodes = [](const auto& nodes) { return as<cgsize_t>(nodes, 1); };
  static constexpr std::int64_t numbers_per_piece = std::int64_t{1} << 17;

  ExtrudedStream stream_;
  const ExtrudedMesh& mesh_;
  StagedFile staged_;
  std::vector<std::string> names_;  ///< of patches, then of the ends' triangles; these three on rank 0 only
  std::unique_ptr<CgnsSink> sink_;
  std::unique_ptr<CgnsPatches> patches_;
};

}  // namespace

void write_cgns_solid(OutputSet& outputs, const ExtrudedMesh& mesh, const std::string& path) {
  CgnsSolidWriter(outputs, mesh, path).write();
}

}  // namespace quadloop
