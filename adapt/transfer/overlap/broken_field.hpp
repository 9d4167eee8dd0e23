#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "adapt/transfer/locate/cell_triangles.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop::adapt {

/// Variables that are linear on each local triangle and may be discontinuous between triangles.
struct BrokenField {
  std::size_t width = 0;
  std::vector<std::array<Point, 3>> triangles;  ///< counter-clockwise
  std::vector<std::int64_t> numbers;            ///< global numbers, as in CellTriangle
  std::vector<double> at_corners;               ///< for each triangle three rows of `width` values

  /// The values at a triangle's corner.
  std::span<const double> row(std::size_t triangle, std::size_t corner) const {
    return std::span(at_corners).subspan((3 * triangle + corner) * width, width);
  }
};

/// From a field at the nodes, with rows for ghost copies.
BrokenField broken_nodal(const Mesh& mesh, const Field& field, std::span<const CellTriangle> triangles);

/// From means over cells: each cell has a linear function with its mean and the gradient from the cells
/// around its nodes (CellsRoundNodes), limited so that at each corner it is within the range of the cells
/// around that corner. Exact for linear functions, except at the boundary; creates no new extrema. The
/// limiter is that of Park, Yoon and Kim, "Multi-dimensional limiting process for hyperbolic conservation
/// laws on unstructured grids", J. Comput. Phys. 229 (2010). *Collective.*
BrokenField broken_cells(const Communicator& comm, const Mesh& mesh, const CellValues& cells,
                         std::span<const CellTriangle> triangles);

}  // namespace quadloop::adapt
