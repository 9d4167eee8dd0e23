#include "io/stream/cell_of_sides.hpp"

#include <algorithm>
#include <type_traits>
#include <vector>

namespace quadloop::io {

namespace {

using Face = FileBoundary::Face;

std::size_t width_of(const Face& face) { return face[3] == FileBoundary::no_node ? 3 : 4; }

/// Returns the face's nodes counter-clockwise as seen from inside the cell.
std::vector<std::int32_t> seen_from_inside(const CellSide& side) {
  std::vector<std::int32_t> nodes(side.nodes.begin(), side.nodes.begin() + width_of(side.nodes));
  if (side.looks_out) std::ranges::reverse(nodes);
  return nodes;
}

template <CellKind kind>
std::string add(FileMesh& mesh, const std::vector<std::int32_t>& nodes, std::int32_t block) {
  typename std::decay_t<decltype(cells_of<kind>(mesh))>::value_type cell;
  if (nodes.size() != cell.size() || std::ranges::count(nodes, FileBoundary::no_node) > 0)
    return "has faces that do not fit together";
  std::ranges::copy(nodes, cell.begin());
  add_cell<kind>(mesh, cell, block);
  return {};
}

}  // namespace

std::int32_t opposite_node(std::span<const CellSide> sides, std::span<const std::int32_t> base,
                           std::int32_t node) {
  for (const CellSide& side : sides) {
    const std::size_t width = width_of(side.nodes);
    for (std::size_t k = 0; k < width; ++k) {
      if (side.nodes[k] != node) continue;
      for (const std::size_t next : {(k + 1) % width, (k + width - 1) % width}) {
        if (std::ranges::count(base, side.nodes[next]) == 0) return side.nodes[next];
      }
    }
  }
  return FileBoundary::no_node;
}

std::string add_cell_of_sides(FileMesh& mesh, std::span<const CellSide> sides, std::int32_t block) {
  const auto quads =
      std::ranges::count_if(sides, [](const CellSide& side) { return width_of(side.nodes) == 4; });
  const auto triangles = std::ssize(sides) - quads;
  const bool prism = triangles == 2 && quads == 3, pyramid = triangles == 4 && quads == 1;
  const bool tetrahedron = triangles == 4 && quads == 0, hexahedron = triangles == 0 && quads == 6;
  if (!prism && !pyramid && !tetrahedron && !hexahedron)
    return "has " + std::to_string(triangles) + " triangles and " + std::to_string(quads) +
           " quads, and is no tetrahedron, pyramid, prism or hexahedron";
  const std::size_t of_base = prism || tetrahedron ? 3 : 4;
  const auto base =
      std::ranges::find_if(sides, [&](const CellSide& side) { return width_of(side.nodes) == of_base; });
  const std::vector<std::int32_t> first = seen_from_inside(*base);
  std::vector<std::int32_t> nodes = first;
  for (const std::int32_t node : first) {
    nodes.push_back(opposite_node(sides, first, node));
    if (tetrahedron || pyramid) break;  // one apex
  }
  if (tetrahedron) return add<CellKind::tetrahedron>(mesh, nodes, block);
  if (pyramid) return add<CellKind::pyramid>(mesh, nodes, block);
  if (prism) return add<CellKind::prism>(mesh, nodes, block);
  return add<CellKind::hexahedron>(mesh, nodes, block);
}

}  // namespace quadloop::io
