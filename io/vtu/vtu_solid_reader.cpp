#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <unordered_map>

#include "io/solid/block_collector.hpp"
#include "io/solid/vtk_cell.hpp"
#include "io/vtu/vtu_arrays.hpp"
#include "io/vtu/vtu_boundaries.hpp"
#include "io/vtu/vtu_solid_file.hpp"

namespace quadloop {

namespace {

bool is_solid(std::int64_t type) { return type >= vtk_tetrahedron; }

class VtuSolidReader {
 public:
  explicit VtuSolidReader(const std::string& path)
      : scan_{path, TextScanner::no_comments}, document_{parse_vtu(scan_)}, numbers_{scan_, document_} {}

  std::optional<SolidMesh> read() {
    if (document_.points > std::numeric_limits<std::int32_t>::max() ||
        document_.cells > std::numeric_limits<std::int32_t>::max())
      scan_.refuse_at(document_.piece_place, "more than 2^31 - 1 points or cells cannot be read on one rank");
    types_ = numbers_.integers(needed("Cells", "types"), document_.cells);
    if (std::ranges::none_of(types_, is_solid)) return std::nullopt;
    read_points();
    read_patches();
    read_blocks();
    read_cells();
    blocks_.put_into(mesh_);
    read_solution();
    std::erase_if(mesh_.patches, [](const SolidPatch& patch) { return patch.faces.empty(); });
    return std::move(mesh_);
  }

 private:
  const VtuArray& needed(const std::string& section, const std::string& name) const {
    for (const VtuArray& array : document_.arrays) {
      if (array.section == section && (name.empty() || array.name == name)) return array;
    }
    scan_.refuse_at(document_.piece_place,
                    "this piece has no array '" + (name.empty() ? section : name) + "' in " + section);
  }

  void read_points() {
    const VtuArray& array = needed("Points", "");
    if (array.components != 3)
      scan_.refuse_at(array.place, "points have three coordinates, not " + std::to_string(array.components));
    const std::vector<double> values = numbers_.reals(array, 3 * document_.points);
    for (std::size_t i = 0; i < values.size(); i += 3) {
      const Point3 p{values[i], values[i + 1], values[i + 2]};
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        scan_.refuse_at(array.place, fmt::format("'{}' is not finite at node {}", array.name, i / 3 + 1));
      mesh_.points.push_back(p);
    }
  }

  /// Those that the file names; others are added as faces name them.
  void read_patches() {
    if (const VtuArray* array = document_.find("FieldData", "boundary_names")) {
      for (const std::string& name : numbers_.texts(*array)) mesh_.patches.push_back({name, "none", {}});
    }
    boundaries_ = find_boundary_numbers(document_, numbers_, types_, vtk_triangle, vtk_quad);
    if (!boundaries_.warning.empty()) mesh_.warnings.push_back(scan_.path() + ": " + boundaries_.warning);
  }

  /// Those that the file names; others are named as cells have them.
  void read_blocks() {
    const VtuArray* array = document_.find("CellData", "block");
    if (array == nullptr || array->components != 1 || array->type.starts_with("Float")) return;
    block_of_ = numbers_.integers(*array, document_.cells);
    if (const VtuArray* names = document_.find("FieldData", "block_names"))
      block_names_ = numbers_.texts(*names);
    for (const std::string& name : block_names_) blocks_.named(name);
  }

  std::int32_t block_of(std::size_t cell) {
    const std::int64_t number = block_of_.empty() ? 0 : block_of_[cell];
    if (number <= 0) return blocks_.named("domain");
    return blocks_.named(number <= std::ssize(block_names_) ? block_names_[number - 1]
                                                            : "block_" + std::to_string(number));
  }

  void read_cells() {
    const VtuArray& connectivity = needed("Cells", "connectivity");
    const VtuArray& offsets_array = needed("Cells", "offsets");
    const std::vector<std::int64_t> offsets = numbers_.integers(offsets_array, document_.cells);
    const std::vector<std::int64_t> nodes = numbers_.integers(connectivity, offsets.back());
    place_ = connectivity.place;
    std::int64_t begin = 0;
    for (std::size_t cell = 0; cell < types_.size(); ++cell) {
      const std::int64_t end = offsets[cell];
      if (end < begin || end > std::ssize(nodes))
        scan_.refuse_at(offsets_array.place,
                        fmt::format("the offset of cell {} is {}, after {}", cell + 1, end, begin));
      add(cell, std::span(nodes).subspan(begin, end - begin));
      begin = end;
    }
  }

  template <std::size_t width>
  std::array<std::int32_t, width> nodes_of(std::size_t cell, std::span<const std::int64_t> nodes) const {
    if (nodes.size() != width)
      scan_.refuse_at(place_, fmt::format("cell {} has {} nodes, not {}", cell + 1, nodes.size(), width));
    std::array<std::int32_t, width> result;
    for (std::size_t k = 0; k < width; ++k) {
      if (nodes[k] < 0 || nodes[k] >= document_.points)
        scan_.refuse_at(place_, fmt::format("cell {} names point {}, which is none of the points 0 to {}",
                                            cell + 1, nodes[k], document_.points - 1));
      result[k] = static_cast<std::int32_t>(nodes[k]);
    }
    return result;
  }

  template <std::size_t width>
  void add_cell(std::size_t cell, const std::array<std::int32_t, width>& nodes) {
    cells_of<width>(mesh_).push_back(nodes);
    places_[width].push_back(static_cast<std::int32_t>(cell));
    if (!block_of_.empty()) blocks_.take(mesh_, block_of(cell));
  }

  void add(std::size_t cell, std::span<const std::int64_t> nodes) {
    switch (types_[cell]) {
      case vtk_tetrahedron: add_cell(cell, nodes_of<4>(cell, nodes)); break;
      case vtk_pyramid: add_cell(cell, nodes_of<5>(cell, nodes)); break;
      case vtk_wedge: add_cell(cell, vtk_wedge_order(nodes_of<6>(cell, nodes))); break;
      case vtk_voxel: {
        const auto n = nodes_of<8>(cell, nodes);
        add_cell(cell, std::array{n[0], n[1], n[3], n[2], n[4], n[5], n[7], n[6]});
        break;
      }
      case vtk_hexahedron: add_cell(cell, nodes_of<8>(cell, nodes)); break;
      case vtk_triangle: {
        const auto n = nodes_of<3>(cell, nodes);
        patch_of(cell).faces.push_back({n[0], n[1], n[2], SolidPatch::no_node});
        break;
      }
      case vtk_quad: patch_of(cell).faces.push_back(nodes_of<4>(cell, nodes)); break;
      default:
        if (types_[cell] < vtk_triangle) break;  // points and lines
        scan_.refuse_at(place_,
                        fmt::format("cell {} is of VTK type {}; only tetrahedra (10), voxels (11), "
                                    "hexahedra (12), prisms (13), pyramids (14), triangles (5) and quads "
                                    "(9) can be read of three dimensions",
                                    cell + 1, vtk_cell_name(types_[cell])));
    }
  }

  SolidPatch& patch_of(std::size_t cell) {
    const std::int64_t number = boundaries_.of_cells.empty() ? 0 : boundaries_.of_cells[cell];
    const bool is_ours = boundaries_.is_ours || boundaries_.of_cells.empty();
    if (is_ours && number >= 1 && number <= std::ssize(mesh_.patches)) return mesh_.patches[number - 1];
    const auto [patch, is_new] = patch_of_number_.try_emplace(number, mesh_.patches.size());
    if (!is_new) return mesh_.patches[patch->second];
    const std::string name = !is_ours      ? boundaries_.name_of(number)
                             : number <= 0 ? "boundary"
                                           : "boundary_" + std::to_string(number);
    const auto found = std::ranges::find(mesh_.patches, name, &SolidPatch::name);
    patch->second = found - mesh_.patches.begin();
    return found != mesh_.patches.end() ? *found : mesh_.patches.emplace_back(SolidPatch{name, "none", {}});
  }

  /// Point data of numbers and cell data of real ones; of several components each is a variable.
  void read_solution() {
    Field solution;
    std::vector<std::vector<double>> at_points, in_cells;
    for (const VtuArray& array : document_.arrays) {
      if (array.section == "PointData" && array.type != "String")
        add_columns(array, document_.points, solution.names, at_points);
      if (array.section == "CellData" && array.type.starts_with("Float"))  // whole numbers are marks
        add_columns(array, document_.cells, solution.cells.names, in_cells);
    }
    if (solution.empty()) return;
    for (std::int64_t i = 0; i < document_.points; ++i) append_row(at_points, i, solution.values);
    for_each_kind_of_cell([&]<std::size_t width>() {
      for (const std::int32_t cell : places_[width]) append_row(in_cells, cell, solution.cells.values);
    });
    mesh_.solution = std::move(solution);
  }

  void add_columns(const VtuArray& array, std::int64_t count, std::vector<std::string>& names,
                   std::vector<std::vector<double>>& columns) const {
    if (array.components > 9) return;
    const std::size_t width = array.components;
    const std::vector<double> values = numbers_.reals(array, count * array.components);
    for (std::size_t k = 0; k < width; ++k) {
      names.push_back(width == 1 ? array.name
                                 : array.name + "_" +
                                       (width <= 3 ? std::string(1, "xyz"[k]) : std::to_string(k + 1)));
      std::vector<double>& column = columns.emplace_back();
      for (std::size_t i = k; i < values.size(); i += width) column.push_back(values[i]);
    }
  }

  static void append_row(const std::vector<std::vector<double>>& columns, std::int64_t row,
                         std::vector<double>& values) {
    for (const std::vector<double>& column : columns) values.push_back(column[row]);
  }

  TextScanner scan_;
  VtuDocument document_;
  VtuNumbers numbers_;
  SolidMesh mesh_;
  std::vector<std::int64_t> types_, block_of_;
  VtuBoundaryNumbers boundaries_;
  std::unordered_map<std::int64_t, std::size_t> patch_of_number_;  ///< of numbers without a name of ours
  std::vector<std::string> block_names_;
  BlockCollector blocks_;
  std::array<std::vector<std::int32_t>, 9>
      places_;             ///< of cells of so many nodes: which of the file's they are
  std::size_t place_ = 0;  ///< of the nodes of cells, for a refusal
};

}  // namespace

std::optional<SolidMesh> read_vtu_solid(const std::string& path) { return VtuSolidReader(path).read(); }

}  // namespace quadloop
