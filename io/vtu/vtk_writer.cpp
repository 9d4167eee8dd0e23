#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/model/node_text.hpp"
#include "io/model/pair_text.hpp"
#include "io/model/strip_text.hpp"
#include "io/stream/mesh_stream.hpp"
#include "io/stream/stream_blocks.hpp"
#include "io/stream/stream_cell_values.hpp"
#include "io/stream/vtk_cell.hpp"
#include "io/vtu/vtk_output.hpp"
#include "io/vtu/vtkhdf_file.hpp"
#include "io/vtu/vtkhdf_output.hpp"
#include "io/vtu/vtu_appended.hpp"
#include "io/vtu/vtu_file.hpp"
#include "io/vtu/vtu_layers.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop::io {

namespace {

/// Consecutive cells or boundary elements of one type.
struct Run {
  std::uint8_t type;
  std::int64_t nodes;  ///< of each
  std::int64_t count;
  std::int32_t patch;  ///< from 1; 0: cells
};

/// The runs of a file, found by the numbers of their elements, which are asked for in ascending order.
class RunsInOrder {
 public:
  explicit RunsInOrder(const std::vector<Run>& runs) : runs_{runs} {}

  const Run& of(std::int64_t element) {
    while (element >= first_ + runs_[at_].count) {
      first_ += runs_[at_].count;
      entries_ += runs_[at_].count * runs_[at_].nodes;
      ++at_;
    }
    return runs_[at_];
  }
  /// Number of nodes of all elements up to this one.
  std::int64_t entries_to(std::int64_t element) {
    const std::int64_t nodes = of(element).nodes;
    return entries_ + (element - first_ + 1) * nodes;
  }

 private:
  const std::vector<Run>& runs_;
  std::size_t at_ = 0;
  std::int64_t first_ = 0, entries_ = 0;  ///< elements, and nodes, before the current run
};

/// Writes a mesh as an unstructured grid of VTK.
class VtkWriter {
 public:
  VtkWriter(const MeshStream& stream, VtkOutput& file)
      : stream_{stream},
        cells_{stream},
        blocks_{stream},
        layered_{stream.is_plane() && has_layers(stream.extruded()->plane) ? &stream.extruded()->plane
                                                                           : nullptr},
        file_{file} {
    list_runs();
  }

  /// Nodal values come before cell data in a plane mesh, after them in a 3D mesh.
  void write() {
    add_fields();
    add_points();
    add_cells();
    if (stream_.is_plane()) add_node_values();
    if (layered_ != nullptr) add_layer_heights();
    add_flags();
    add_cell_values();
    if (!stream_.is_plane()) add_node_values();
    file_.write(stream_.counts().nodes, elements_);
  }

 private:
  /// In file order: cells, then for each boundary its lines, or its triangles and its quads.
  void list_runs() {
    for_each_kind([&]<CellKind kind>() {
      runs_.push_back({vtk_type_of<kind>, cell_width<kind>, stream_.counts().of(kind), 0});
    });
    std::int32_t number = 0;
    for (const StreamedPatch& patch : stream_.patches()) {
      ++number;
      runs_.push_back({vtk_line, 2, patch.edges, number});
      runs_.push_back({vtk_triangle, 3, patch.triangles, number});
      runs_.push_back({vtk_quad, 4, patch.quads, number});
    }
    for (const Run& run : runs_) {
      elements_ += run.count;
      entries_ += run.count * run.nodes;
    }
  }

  void add_fields() {
    file_.name_boundaries(stream_.patch_names(), stream_.is_plane() ? 1 : 2);
    if (blocks_.are_named()) file_.add_field("block_names", blocks_.names());
    if (layered_ != nullptr) add_layers();
    if (std::vector<std::string> comments = comments_of_plane(); !comments.empty())
      file_.add_field(vtu_strips, std::move(comments));
  }

  /// Count and thickness of each boundary's layers.
  void add_layers() {
    std::vector<std::int32_t> counts;
    std::vector<double> thicknesses;
    for (const BoundaryEdges* boundary : stream_.boundaries()->present()) {
      counts.push_back(boundary->layers.count);
      thicknesses.push_back(boundary->layers.thickness);
    }
    file_.add_field(vtu_layer_counts, std::move(counts));
    file_.add_field(vtu_layer_thicknesses, std::move(thicknesses));
  }

  /// Strips, pairs and named nodes of a plane mesh.
  std::vector<std::string> comments_of_plane() const {
    std::vector<std::string> comments;
    if (!stream_.is_plane()) return comments;
    const Mesh& mesh = stream_.extruded()->plane;
    for (const StripLayers& strip : mesh.strips) comments.push_back(comments_of(strip));
    for (const PeriodicPair& pair : mesh.pairs) comments.push_back(comment_of(pair));
    for (const NamedNode& node : mesh.named_nodes) comments.push_back(comment_of(node));
    return comments;
  }

  void add_points() {
    file_.add<double>(VtkSection::points, vtk_points, 3, stream_.counts().nodes, [this] {
      file_.put_rows(stream_.point_rows(), [&](std::int64_t i) {
        const Point3 p = stream_.point(i);
        return std::array{p.x, p.y, p.z};
      });
    });
  }

  void add_cells() {
    file_.add<std::int64_t>(VtkSection::cells, vtk_connectivity, 1, entries_, [this] { put_connectivity(); });
    const std::int64_t first = file_.has_first_offset() ? 1 : 0;
    file_.add<std::int64_t>(VtkSection::cells, vtk_offsets, 1, elements_ + first, [this, first] {
      RunsInOrder runs(runs_);
      file_.put_shared_rows(elements_ + first, [&](std::int64_t i) {
        return std::array{i < first ? std::int64_t{0} : runs.entries_to(i - first)};
      });
    });
    file_.add<std::uint8_t>(VtkSection::cells, vtk_types, 1, elements_, [this] { put_of_runs(&Run::type); });
  }

  /// Adds boundary and block numbers.
  void add_flags() {
    file_.add<std::int32_t>(VtkSection::cell_data, "boundary", 1, elements_,
                            [this] { put_of_runs(&Run::patch); });
    if (blocks_.are_named())
      file_.add<std::int32_t>(VtkSection::cell_data, "block", 1, elements_, [this] { put_blocks(); });
  }

  /// Block numbers of cells, from 1; 0 for boundary elements, which come last.
  void put_blocks() {
    for_each_kind([&]<CellKind kind>() {
      file_.put_rows(stream_.cell_rows<kind>(),
                     [&](std::int64_t i) { return std::array{blocks_.of<kind>(i) + 1}; });
    });
    file_.put_shared_rows(elements_ - stream_.counts().cells(),
                          [](std::int64_t) { return std::array{std::int32_t{0}}; });
  }

  void put_connectivity() {
    for_each_kind([&]<CellKind kind>() {
      file_.put_rows(stream_.cell_rows<kind>(),
                     [&](std::int64_t i) { return in_vtk_order(stream_.cell<kind>(i)); });
    });
    if (stream_.is_plane()) {
      file_.put_edges(*stream_.boundaries(), 1,
                      [](const BoundaryStream::Edge& edge, std::int64_t) { return edge; });
    } else if (stream_.boundaries() != nullptr) {
      file_.put_edges(
          *stream_.boundaries(), stream_.layers(),
          [&](const BoundaryStream::Edge& edge, std::int64_t layer) { return stream_.side(edge, layer); });
    }
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) {
      put_faces<3>(n);
      put_faces<4>(n);
    }
  }

  template <std::size_t width>
  void put_faces(std::size_t patch) {
    file_.put_rows(stream_.face_rows<width>(patch),
                   [&](std::int64_t i) { return stream_.face<width>(patch, i); });
  }

  /// Writes one value for each cell and boundary element.
  template <class Number>
  void put_of_runs(Number Run::*value) {
    RunsInOrder runs(runs_);
    file_.put_shared_rows(elements_, [&](std::int64_t i) { return std::array{runs.of(i).*value}; });
  }

  void add_node_values() {
    const std::vector<std::string> names = file_.names_of(stream_.variables());
    for (std::size_t k = 0; k < names.size(); ++k)
      add_of_nodes(names[k], [this, k](std::int64_t i) { return stream_.value(i, k); });
  }

  void add_cell_values() {
    const std::vector<std::string> names = file_.names_of(cells_.names());
    for (std::size_t k = 0; k < names.size(); ++k)
      file_.add<double>(VtkSection::cell_data, names[k], 1, elements_, [this, k] { put_cell_variable(k); });
  }

  /// Adds an array with a value for each point.
  template <class Value>
  void add_of_nodes(const std::string& name, Value value) {
    file_.add<double>(VtkSection::point_data, name, 1, stream_.counts().nodes, [this, value] {
      file_.put_rows(stream_.point_rows(), [&](std::int64_t i) { return std::array<double, 1>{value(i)}; });
    });
  }

  void add_layer_heights() {
    places_ = layer_places(stream_.communicator(), *layered_);
    heights_ = heights_to_front(stream_.communicator(), *layered_, places_);
    const auto at_wall = [this](std::int64_t i) { return on_layered_wall(*layered_, places_.begin()[i]); };
    add_of_nodes(vtu_layer_height_asked, [this, at_wall](std::int64_t i) {
      return at_wall(i) ? layers_at(*layered_, places_.begin()[i]).thickness : 0;
    });
    add_of_nodes(vtu_layer_height,
                 [this, at_wall](std::int64_t i) { return at_wall(i) ? heights_.begin()[i] : 0; });
  }

  /// Boundary elements have the values of the adjacent cell.
  void put_cell_variable(std::size_t variable) {
    for_each_kind([&]<CellKind kind>() {
      file_.put_rows(stream_.cell_rows<kind>(),
                     [&](std::int64_t i) { return std::array{cells_.of_cell<kind>(i, variable)}; });
    });
    if (const auto sides = cells_.at_sides(variable))
      file_.put_edges(*sides, cells_.sides_on_edge(), [](const BoundaryStream::Edge& edge, std::int64_t) {
        return std::array{StreamCellValues::value_of(edge)};
      });
    for (std::size_t n = stream_.side_patches(); n < stream_.patches().size(); ++n) {
      file_.put_rows(stream_.face_rows<3>(n),
                     [&](std::int64_t i) { return std::array{cells_.of_face<3>(n, i, variable)}; });
      file_.put_rows(stream_.face_rows<4>(n),
                     [&](std::int64_t i) { return std::array{cells_.of_face<4>(n, i, variable)}; });
    }
  }

  const MeshStream& stream_;
  const StreamCellValues cells_;
  const StreamBlocks blocks_;
  const Mesh* layered_;  ///< plane mesh, if it has layers
  VtkOutput& file_;
  std::vector<Run> runs_;
  std::int64_t elements_ = 0, entries_ = 0;
  LayerPlaces places_;
  IdVector<NodeId, double> heights_;
};

}  // namespace

void write_vtu(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  VtuAppended file(outputs, path);
  VtkWriter(mesh, file).write();
}

void write_vtkhdf(OutputSet& outputs, const MeshStream& mesh, const std::string& path) {
  VtkHdfOutput file(outputs, path);
  VtkWriter(mesh, file).write();
}

}  // namespace quadloop::io
