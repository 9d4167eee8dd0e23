#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "adapt/transfer/locate/cell_triangles.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop {

/// Some variables, linear on each of this rank's triangles and of any value where two of them meet.
struct BrokenField {
  std::size_t width = 0;
  std::vector<std::array<Point, 3>> triangles;  ///< counter-clockwise
  std::vector<std::int64_t> numbers;            ///< of each triangle over all ranks, as CellTriangle has them
  std::vector<double> at_corners;               ///< of each triangle three rows of `width` values

  /// Of a triangle's corner.
  std::span<const double> row(std::size_t triangle, std::size_t corner) const {
    return std::span(at_corners).subspan((3 * triangle + corner) * width, width);
  }
};

/// From a field at the nodes, with rows for copies.
BrokenField broken_nodal(const Mesh& mesh, const Field& field, std::span<const CellTriangle> triangles);

/// From means over cells: each cell's own linear function that has its mean, with the gradient of the cells
/// round its nodes (CellsRoundNodes), lowered until at no corner it leaves the range of the cells round that
/// corner. Exact for linear functions, but at the boundary; no new extrema. The limit is that of Park, Yoon
/// and Kim, "Multi-dimensional limiting process for hyperbolic conservation laws on unstructured grids", J.
/// Comput. Phys. 229 (2010). *Collective.*
BrokenField broken_cells(const Communicator& comm, const Mesh& mesh, const CellValues& cells,
                         std::span<const CellTriangle> triangles);

}  // namespace quadloop
