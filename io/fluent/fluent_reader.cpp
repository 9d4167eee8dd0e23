#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <set>

#include "io/fluent/fluent_file.hpp"
#include "io/fluent/fluent_sections.hpp"
#include "io/fluent/fluent_zones.hpp"
#include "io/model/cell_faces.hpp"
#include "io/model/clean_up.hpp"
#include "io/stream/cell_of_sides.hpp"

namespace quadloop::io {

namespace {

class FluentReader {
 public:
  explicit FluentReader(const std::string& path) : file_{path} {}

  MeshOfFile read() {
    mesh_.dimension = file_.dimension();
    mesh_.points = file_.points();
    add_cells();
    add_boundaries();
    if (!is_plane()) {
      drop_empty_groups(mesh_);
      return std::move(mesh_);
    }
    drop_unused_nodes(mesh_, file_.scan().path());
    return plane_mesh(std::move(mesh_), file_.scan());
  }

 private:
  bool is_plane() const { return mesh_.dimension == 2; }

  void add_cells() {
    const std::vector<std::int64_t> zone_of = file_.zones_of_cells();
    block_of_.assign(zone_of.size(), -1);
    for (std::size_t cell = 1; cell < zone_of.size(); ++cell) {
      block_of_[cell] = mesh_.block_named(file_.block_name(zone_of[cell]));
      is_plane() ? add_plane_cell(static_cast<std::int32_t>(cell))
                 : add_cell(static_cast<std::int32_t>(cell));
    }
  }

  void add_cell(std::int32_t cell) {
    std::vector<CellSide> sides;
    for (const std::int32_t f : file_.faces_of(cell)) {
      const FluentFace& face = file_.faces()[f];
      sides.push_back({face.nodes, face.cells[0] != cell});
    }
    if (const std::string fault = add_cell_of_sides(mesh_, sides, block_of_[cell]); !fault.empty())
      file_.scan().refuse_at(sides.empty() ? 0 : file_.faces()[file_.faces_of(cell)[0]].place,
                             fmt::format("cell {} {}", cell, fault));
  }

  /// Connects the cell's faces node by node; the first face has the cell on its left.
  void add_plane_cell(std::int32_t cell) {
    const std::span<const std::int32_t> own = file_.faces_of(cell);
    const std::vector<FluentFace>& faces = file_.faces();
    if (own.size() != 3 && own.size() != 4)
      file_.scan().refuse_at(
          own.empty() ? 0 : faces[own[0]].place,
          fmt::format("cell {} has {} faces; only triangles and quadrilaterals can be read", cell,
                      own.size()));
    std::array<std::int32_t, 4> nodes =
        faces[own[0]].cells[0] == cell ? std::array{faces[own[0]].nodes[0], faces[own[0]].nodes[1], -1, -1}
                                       : std::array{faces[own[0]].nodes[1], faces[own[0]].nodes[0], -1, -1};
    std::array<bool, 4> used{true};
    for (std::size_t k = 1; k < own.size(); ++k) {
      const std::int32_t next = next_node(own, used, nodes[k]);
      const bool closes = k + 1 == own.size();
      if (next < 0 || (closes && next != nodes[0]))
        file_.scan().refuse_at(faces[own[0]].place,
                               fmt::format("the faces of cell {} do not go round it", cell));
      if (!closes) nodes[k + 1] = next;
    }
    if (own.size() == 3) {
      io::add_cell<CellKind::triangle>(mesh_, std::array{nodes[0], nodes[1], nodes[2]}, block_of_[cell]);
    } else {
      io::add_cell<CellKind::quad>(mesh_, nodes, block_of_[cell]);
    }
  }

  /// Returns the other end of an unused face at this node; -1 if there is none.
  std::int32_t next_node(std::span<const std::int32_t> own, std::array<bool, 4>& used,
                         std::int32_t node) const {
    for (std::size_t k = 1; k < own.size(); ++k) {
      const auto [first, second] = file_.faces()[own[k]].ends();
      if (used[k] || (first != node && second != node)) continue;
      used[k] = true;
      return first == node ? second : first;
    }
    return -1;
  }

  static bool is_interior(const FluentFace& face) {
    return face.is_inside() && (face.type == fluent_interior || face.type == 0);
  }

  /// Returns the zones of inner faces some of which have the same block on both sides: these are neither
  /// boundaries, even where two blocks meet, nor inner lines. A zone with only edges between blocks is their
  /// boundary, unless it has the name that our writer uses for the others.
  std::set<std::int64_t> inner_zones() const {
    std::set<std::int64_t> zones, rest = zones_round_cells();
    for (const auto& [zone, name] : file_.zone_names()) {
      if (name == fluent_inner_zone) rest.insert(zone);
    }
    std::set<std::int32_t> blocks;  // those of the faces in `rest`
    const auto is_inside = [&](const FluentFace& face) {
      return is_interior(face) && block_of_[face.cells[0]] == block_of_[face.cells[1]];
    };
    for (const FluentFace& face : file_.faces()) {
      if (is_inside(face) && rest.contains(face.zone)) blocks.insert(block_of_[face.cells[0]]);
    }
    for (const FluentFace& face : file_.faces()) {
      if (is_inside(face) && !blocks.contains(block_of_[face.cells[0]])) zones.insert(face.zone);
    }
    zones.insert(rest.begin(), rest.end());
    return zones;
  }

  /// Returns the zones of inner faces that a cell has more than two faces in. In a block with faces of such a
  /// zone the other zones are inner lines.
  std::set<std::int64_t> zones_round_cells() const {
    std::set<std::int64_t> zones;
    for (std::size_t cell = 1; cell < block_of_.size(); ++cell) {
      std::array<std::int64_t, 4> of_faces{};
      std::size_t count = 0;
      for (const std::int32_t f : file_.faces_of(static_cast<std::int32_t>(cell))) {
        if (is_interior(file_.faces()[f]) && count < of_faces.size())
          of_faces[count++] = file_.faces()[f].zone;
      }
      for (std::size_t k = 0; k < count; ++k) {
        if (std::count(of_faces.begin(), of_faces.begin() + count, of_faces[k]) > 2)
          zones.insert(of_faces[k]);
      }
    }
    return zones;
  }

  /// In a 3D mesh only faces with one cell, reversed such that their normals point outwards.
  void add_boundaries() {
    const std::set<std::int64_t> inner = is_plane() ? inner_zones() : std::set<std::int64_t>{};
    for (const FluentFace& face : file_.faces()) {
      if (is_plane() ? is_interior(face) && inner.contains(face.zone) : face.is_inside()) continue;
      FileBoundary& boundary = mesh_.boundaries[mesh_.boundary_named(file_.zone_name(face.zone))];
      boundary.condition = condition_of_fluent(face.type);
      boundary.places.push_back(face.place);
      FileBoundary::Face& nodes = boundary.faces.emplace_back(face.nodes);
      if (!is_plane() && face.cells[0] != 0)
        std::reverse(nodes.begin(), nodes.begin() + corners_of(face.nodes).size());
    }
  }

  FluentSections file_;
  FileMesh mesh_;
  std::vector<std::int32_t> block_of_;  ///< for each cell, from 1
};

}  // namespace

bool is_fluent(const std::string& path) {
  std::ifstream file(path);
  char first = 0;
  return file >> first && first == '(';
}

MeshOfFile read_fluent(const std::string& path) { return FluentReader(path).read(); }

}  // namespace quadloop::io
