#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/model/point3.hpp"
#include "io/text/name_index.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// The boundary faces of one name: edges in a plane mesh, triangles and quads in a 3D mesh.
struct FileBoundary {
  static constexpr std::int32_t no_node = -1;
  /// Nodes in order; no_node after the last of an edge or triangle.
  using Face = std::array<std::int32_t, 4>;

  std::string name;
  BoundaryCondition condition = {};
  std::vector<Face> faces;
  bool is_empty = false;     ///< an end of a plane mesh that is one cell thick ("empty" in OpenFOAM)
  bool is_periodic = false;  ///< whether its nodes have partners on another boundary ("cyclic" in OpenFOAM)
  WallLayers layers = {};    ///< in a plane mesh
  std::vector<std::size_t> places = {};  ///< of the faces in the file, for messages; may be empty
};

/// Kinds of cells: the first two occur in plane meshes, the others in 3D meshes.
enum class CellKind : std::uint8_t { triangle, quad, tetrahedron, pyramid, prism, hexahedron };
inline constexpr std::size_t cell_kinds = 6;

/// A 2D or 3D mesh as stored in a file, whole on one rank. Nodes are numbered from 0. The nodes of a 3D cell
/// are in CGNS order: the first three or four counter-clockwise as seen from the others, which follow in the
/// same order.
struct FileMesh {
  std::int32_t dimension = 3;
  std::vector<Point3> points;  ///< z = 0 in a plane mesh
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::array<std::int32_t, 4>> quads;
  std::vector<std::array<std::int32_t, 4>> tetrahedra;
  std::vector<std::array<std::int32_t, 5>> pyramids;
  std::vector<std::array<std::int32_t, 6>> prisms;
  std::vector<std::array<std::int32_t, 8>> hexahedra;
  std::vector<FileBoundary> boundaries;
  std::optional<Field> solution;  ///< cell rows are in the order of the kinds
  std::vector<std::string> block_names;
  /// For each kind the block of each cell, an index into block_names; empty if there is no block information.
  std::array<std::vector<std::int32_t>, cell_kinds> cell_to_block;
  std::vector<std::int32_t> periodic_nodes;  ///< on sides that a plane file marks as periodic
  std::vector<StripLayers> strips;           ///< of a plane mesh
  std::vector<PeriodicPair> pairs;           ///< of a plane mesh
  std::vector<NamedNode> named_nodes;        ///< of a plane mesh
  std::vector<std::string> warnings;         ///< what the reader changed or omitted, with the file's name

  /// Return the index of the boundary, or block, of this name, which is added if necessary.
  std::int32_t boundary_named(const std::string& name) {
    const auto [number, is_new] = boundary_numbers.entry_of(name);
    if (is_new) boundaries.push_back({name, {}, {}});
    return number;
  }
  std::int32_t block_named(const std::string& name) {
    const auto [number, is_new] = block_numbers.entry_of(name);
    if (is_new) block_names.push_back(name);
    return number;
  }
  bool has_blocks() const { return block_names.size() > 1; }

  /// Index of the names passed to the functions above.
  NameIndex boundary_numbers = {}, block_numbers = {};
};

/// Returns the cells of a kind.
template <CellKind kind, class FileMeshOrConst>
auto& cells_of(FileMeshOrConst& mesh) {
  if constexpr (kind == CellKind::triangle) return mesh.triangles;
  if constexpr (kind == CellKind::quad) return mesh.quads;
  if constexpr (kind == CellKind::tetrahedron) return mesh.tetrahedra;
  if constexpr (kind == CellKind::pyramid) return mesh.pyramids;
  if constexpr (kind == CellKind::prism) return mesh.prisms;
  if constexpr (kind == CellKind::hexahedron) return mesh.hexahedra;
}

/// Number of nodes of a cell.
template <CellKind kind>
inline constexpr std::size_t cell_width = kind == CellKind::triangle                                ? 3
                                          : kind == CellKind::quad || kind == CellKind::tetrahedron ? 4
                                          : kind == CellKind::pyramid                               ? 5
                                          : kind == CellKind::prism                                 ? 6
                                                                                                    : 8;

/// Returns the kind of 3D cells with this number of nodes.
template <std::size_t width>
constexpr CellKind kind_of_width() {
  static_assert(width == 4 || width == 5 || width == 6 || width == 8);
  return width == 4   ? CellKind::tetrahedron
         : width == 5 ? CellKind::pyramid
         : width == 6 ? CellKind::prism
                      : CellKind::hexahedron;
}

/// Returns the 3D cells with this number of nodes.
template <std::size_t width, class FileMeshOrConst>
auto& cells_of(FileMeshOrConst& mesh) {
  return cells_of<kind_of_width<width>()>(mesh);
}

/// Calls `visit.operator()<kind>()` for the kinds in their order.
template <class Visit>
void for_each_kind(const Visit& visit) {
  visit.template operator()<CellKind::triangle>();
  visit.template operator()<CellKind::quad>();
  visit.template operator()<CellKind::tetrahedron>();
  visit.template operator()<CellKind::pyramid>();
  visit.template operator()<CellKind::prism>();
  visit.template operator()<CellKind::hexahedron>();
}

/// Calls `visit.operator()<width>()` for the numbers of nodes of 3D cells, in the order of their kinds.
template <class Visit>
void for_each_kind_of_cell(const Visit& visit) {
  visit.template operator()<4>();
  visit.template operator()<5>();
  visit.template operator()<6>();
  visit.template operator()<8>();
}

/// Adds a cell to a block.
template <CellKind kind, class Nodes>
void add_cell(FileMesh& mesh, const Nodes& nodes, std::int32_t block) {
  cells_of<kind>(mesh).push_back(nodes);
  mesh.cell_to_block[static_cast<std::size_t>(kind)].push_back(block);
}

/// Returns the number of cells of all kinds.
inline std::int64_t cell_count(const FileMesh& mesh) {
  std::int64_t count = 0;
  for_each_kind([&]<CellKind kind>() { count += std::ssize(cells_of<kind>(mesh)); });
  return count;
}

/// Returns the block of each cell, in the order of the kinds.
inline std::vector<std::int32_t> blocks_of_cells(const FileMesh& mesh) {
  std::vector<std::int32_t> all;
  for (const auto& blocks : mesh.cell_to_block) all.insert(all.end(), blocks.begin(), blocks.end());
  return all;
}

/// Assigns the cells, in the order of the kinds, to blocks named after their identifiers, in ascending order:
/// "block_1", or "domain" if all are equal.
void set_blocks(FileMesh& mesh, const std::vector<std::int64_t>& identifiers);

}  // namespace quadloop::io
