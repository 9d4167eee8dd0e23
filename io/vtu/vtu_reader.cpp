#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/model/clean_up.hpp"
#include "io/stream/vtk_cell.hpp"
#include "io/vtu/vtu_arrays.hpp"
#include "io/vtu/vtu_boundaries.hpp"
#include "io/vtu/vtu_file.hpp"
#include "io/vtu/vtu_names.hpp"

namespace quadloop::io {

namespace {

class VtuReader {
 public:
  explicit VtuReader(const std::string& path)
      : scan_{path, TextScanner::no_comments}, document_{parse_vtu(scan_)}, numbers_{scan_, document_} {}

  MeshOfFile read() {
    if (document_.points > std::numeric_limits<std::int32_t>::max() ||
        document_.cells > std::numeric_limits<std::int32_t>::max()) {
      scan_.refuse_at(document_.piece_place, "more than 2^31 - 1 points or cells cannot be read on one rank");
    }
    types_ = numbers_.integers(needed("Cells", "types"), document_.cells);
    mesh_.dimension = std::ranges::any_of(types_, is_of_space) ? 3 : 2;
    read_points();
    read_cells();
    read_solution();
    if (is_plane()) return plane_mesh(std::move(mesh_), scan_);
    drop_empty_groups(mesh_);
    return std::move(mesh_);
  }

 private:
  static bool is_of_space(std::int64_t type) { return type >= vtk_tetrahedron; }
  bool is_plane() const { return mesh_.dimension == 2; }

  void read_points() {
    const VtuArray& array = needed("Points", "");
    if (array.components != 3)
      scan_.refuse_at(array.place, "points have three coordinates, not " + std::to_string(array.components));
    const std::vector<double> values = finite_reals(array, 3 * document_.points, 3);
    for (std::size_t i = 0; i < values.size(); i += 3) {
      mesh_.points.push_back({values[i], values[i + 1], is_plane() ? 0 : values[i + 2]});
      if (!is_plane() || values[i + 2] == values[2]) continue;
      scan_.refuse_at(
          array.place,
          fmt::format("node {} lies at z = {}, the first at z = {}; a mesh lies in a plane z = constant",
                      i / 3 + 1, values[i + 2], values[2]));
    }
  }

  /// Returns a required array; of any name if none is given.
  const VtuArray& needed(const std::string& section, const std::string& name) const {
    for (const VtuArray& array : document_.arrays) {
      if (array.section == section && (name.empty() || array.name == name)) return array;
    }
    scan_.refuse_at(document_.piece_place,
                    "this piece has no array '" + (name.empty() ? section : name) + "' in " + section);
  }

  std::vector<double> finite_reals(const VtuArray& array, std::int64_t count, std::size_t width,
                                   const char* place = "node") const {
    std::vector<double> values = numbers_.reals(array, count);
    const auto bad =
        std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
    if (bad != values.end()) {
      scan_.refuse_at(array.place, fmt::format("'{}' is not finite at {} {}", array.name, place,
                                               (bad - values.begin()) / width + 1));
    }
    return values;
  }

  void read_cells() {
    const VtuArray& connectivity = needed("Cells", "connectivity");
    const VtuArray& offsets_array = needed("Cells", "offsets");
    const std::vector<std::int64_t> offsets = numbers_.integers(offsets_array, document_.cells);
    const std::vector<std::int64_t> nodes =
        numbers_.integers(connectivity, offsets.empty() ? 0 : offsets.back());
    find_boundaries();
    const std::vector<std::int64_t> blocks = cell_numbers("block");
    names_ = read_vtu_names(scan_, document_, numbers_, mesh_);
    std::int64_t begin = 0;
    for (std::size_t cell = 0; cell < types_.size(); ++cell) {
      const std::int64_t end = offsets[cell];
      if (end < begin || end > std::ssize(nodes)) {
        scan_.refuse_at(offsets_array.place,
                        fmt::format("the offset of cell {} is {}, after {}", cell + 1, end, begin));
      }
      const auto of_cell = std::span(nodes).subspan(begin, end - begin);
      place_ = connectivity.place;
      cell_ = cell + 1;
      block_ = blocks.empty() ? 0 : blocks[cell];
      is_plane() ? add_plane_element(of_cell) : add_element(of_cell);
      begin = end;
    }
  }

  void find_boundaries() {
    boundaries_ = is_plane() ? find_boundary_numbers(document_, numbers_, types_, vtk_line, vtk_line)
                             : find_boundary_numbers(document_, numbers_, types_, vtk_triangle, vtk_quad);
    if (!boundaries_.warning.empty()) mesh_.warnings.push_back(scan_.path() + ": " + boundaries_.warning);
  }
  /// Returns the boundary of the current element.
  std::string boundary_name() const {
    const std::int64_t number = boundaries_.of_cells.empty() ? 0 : boundaries_.of_cells[cell_ - 1];
    if (boundaries_.is_ours || boundaries_.of_cells.empty())
      return name_of(names_.boundaries, number, "boundary", "boundary");
    return boundaries_.name_of(number);
  }

  /// Returns integers of our own cell data; empty if there are none.
  std::vector<std::int64_t> cell_numbers(const std::string& name) const {
    const VtuArray* array = document_.find("CellData", name);
    if (array == nullptr || array->components != 1 || array->type.starts_with("Float")) return {};
    return numbers_.integers(*array, document_.cells);
  }

  static std::string name_of(const std::vector<std::string>& names, std::int64_t number, const char* kind,
                             const char* without) {
    if (number <= 0) return without;
    if (number <= std::ssize(names)) return names[number - 1];
    return fmt::format("{}_{}", kind, number);
  }

  template <std::size_t width>
  std::array<std::int32_t, width> nodes_of(std::span<const std::int64_t> nodes) const {
    if (nodes.size() != width)
      scan_.refuse_at(place_, fmt::format("cell {} has {} nodes, not {}", cell_, nodes.size(), width));
    std::array<std::int32_t, width> result;
    for (std::size_t k = 0; k < width; ++k) {
      if (nodes[k] < 0 || nodes[k] >= document_.points) {
        scan_.refuse_at(place_, fmt::format("cell {} names point {}, which is none of the points 0 to {}",
                                            cell_, nodes[k], document_.points - 1));
      }
      result[k] = static_cast<std::int32_t>(nodes[k]);
    }
    return result;
  }

  void add_plane_element(std::span<const std::int64_t> nodes) {
    const std::int64_t type = types_[cell_ - 1];
    if (type == vtk_vertex || type == vtk_poly_vertex) return;
    if (type == vtk_line) return add_face(nodes_of<2>(nodes));
    if (type == vtk_triangle || (type == vtk_polygon && nodes.size() == 3))
      return add<CellKind::triangle>(nodes_of<3>(nodes));
    if (type == vtk_quad || type == vtk_pixel || (type == vtk_polygon && nodes.size() == 4)) {
      auto corners = nodes_of<4>(nodes);
      if (type == vtk_pixel) std::swap(corners[2], corners[3]);
      return add<CellKind::quad>(corners);
    }
    scan_.refuse_at(place_, fmt::format("cell {} is of VTK type {} with {} nodes; only triangles (5), "
                                        "quads (9) and lines (3) can be read",
                                        cell_, vtk_cell_name(type), nodes.size()));
  }

  void add_element(std::span<const std::int64_t> nodes) {
    const std::int64_t type = types_[cell_ - 1];
    switch (type) {
      case vtk_tetrahedron: return add<CellKind::tetrahedron>(nodes_of<4>(nodes));
      case vtk_pyramid: return add<CellKind::pyramid>(nodes_of<5>(nodes));
      case vtk_wedge: return add<CellKind::prism>(vtk_wedge_order(nodes_of<6>(nodes)));
      case vtk_voxel: {
        const auto n = nodes_of<8>(nodes);
        return add<CellKind::hexahedron>(std::array{n[0], n[1], n[3], n[2], n[4], n[5], n[7], n[6]});
      }
      case vtk_hexahedron: return add<CellKind::hexahedron>(nodes_of<8>(nodes));
      case vtk_triangle: return add_face(nodes_of<3>(nodes));
      case vtk_quad: return add_face(nodes_of<4>(nodes));
      default:
        if (type < vtk_triangle) return;  // points and lines
        scan_.refuse_at(place_, fmt::format("cell {} is of VTK type {}; only tetrahedra (10), voxels (11), "
                                            "hexahedra (12), prisms (13), pyramids (14), triangles (5) and "
                                            "quads (9) can be read of three dimensions",
                                            cell_, vtk_cell_name(type)));
    }
  }

  template <CellKind kind, class Nodes>
  void add(const Nodes& nodes) {
    add_cell<kind>(mesh_, nodes, mesh_.block_named(name_of(names_.blocks, block_, "block", "domain")));
    cells_of_kind_[static_cast<std::size_t>(kind)].push_back(static_cast<std::int32_t>(cell_ - 1));
  }

  template <std::size_t width>
  void add_face(const std::array<std::int32_t, width>& nodes) {
    FileBoundary& boundary = mesh_.boundaries[mesh_.boundary_named(boundary_name())];
    FileBoundary::Face& face = boundary.faces.emplace_back();
    face.fill(FileBoundary::no_node);
    std::ranges::copy(nodes, face.begin());
    boundary.places.push_back(place_);
  }

  void read_solution() {
    Field solution;
    std::vector<std::vector<double>> at_points, in_cells;
    for (const VtuArray& array : document_.arrays) {
      if (is_nodal_variable(array, names_))
        add_columns(array, document_.points, "node", solution.names, at_points);
      if (is_cell_variable(array))
        add_columns(array, document_.cells, "cell", solution.cells.names, in_cells);
    }
    if (solution.empty()) return;
    for (std::int64_t i = 0; i < document_.points; ++i) append_row(at_points, i, solution.values);
    for (const auto& cells : cells_of_kind_) {
      for (const std::int32_t cell : cells) append_row(in_cells, cell, solution.cells.values);
    }
    mesh_.solution = std::move(solution);
  }

  static void append_row(const std::vector<std::vector<double>>& columns, std::int64_t row,
                         std::vector<double>& values) {
    for (const std::vector<double>& column : columns) values.push_back(column[row]);
  }

  void add_columns(const VtuArray& array, std::int64_t count, const char* place,
                   std::vector<std::string>& names, std::vector<std::vector<double>>& columns) const {
    const std::size_t width = array.components;
    name_of_component(scan_, array, 0);  // refuses too many
    const std::vector<double> values = finite_reals(array, count * array.components, width, place);
    for (std::size_t k = 0; k < width; ++k) {
      std::vector<double> column(count);
      for (std::int64_t i = 0; i < count; ++i) column[i] = values[i * width + k];
      if (is_plane() && is_third(array, k) &&
          std::all_of(column.begin(), column.end(), [](double value) { return value == 0; }))
        continue;
      names.push_back(name_of_component(scan_, array, k));
      columns.push_back(std::move(column));
    }
  }

  TextScanner scan_;
  VtuDocument document_;
  VtuNumbers numbers_;
  FileMesh mesh_;
  std::vector<std::int64_t> types_;
  VtuNames names_;
  VtuBoundaryNumbers boundaries_;
  std::array<std::vector<std::int32_t>, cell_kinds> cells_of_kind_;  ///< numbers among all cells of the file
  std::size_t place_ = 0, cell_ = 0;  ///< of the current element; elements are numbered from 1
  std::int64_t block_ = 0;            ///< its number in the file
};

}  // namespace

MeshOfFile read_vtu(const std::string& path) { return VtuReader(path).read(); }

}  // namespace quadloop::io
