#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "adapt/transfer/locate/point_cells.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// A triangle cell or half of a quadrilateral, counter-clockwise. The global number is twice that of the cell
/// (triangles first, then quadrilaterals), plus one for the second half of a quadrilateral.
struct CellTriangle {
  std::array<NodeId, 3> nodes;
  std::int64_t number = 0;
};

/// The centre of the bounding box of all ranks' nodes. *Collective.*
Point centre_of_nodes(const Communicator& comm, const Mesh& mesh);

/// Whether its sides lie along the axes, from the lower left corner on: most quads are whole leaves.
inline bool is_rectangle(const std::array<Point, 4>& p) {
  return p[0].y == p[1].y && p[1].x == p[2].x && p[2].y == p[3].y && p[3].x == p[0].x && p[0].x < p[1].x &&
         p[1].y < p[2].y;
}

/// The corner of such a rectangle farthest from the centre along both axes, the right or upper one of two
/// equally far ones; it has the highest tie_rank().
inline std::size_t farthest_corner(Point centre, const std::array<Point, 4>& p) {
  const bool is_right = std::abs(p[2].x - centre.x) >= std::abs(p[0].x - centre.x);
  const bool is_upper = std::abs(p[2].y - centre.y) >= std::abs(p[0].y - centre.y);
  if (is_upper) return is_right ? 2 : 3;
  return is_right ? 1 : 0;
}

/// A cell's triangles, one or two. One without area is left out, one that runs clockwise turned. A quad is
/// split along the diagonal through its corner of the highest tie rank, the one farthest from `centre` along
/// an axis, so that mirror images of a mesh are split alike. Where a half would not be counter-clockwise (the
/// quad is not convex there) it is the other diagonal.
struct TrianglesOfCell {
  std::array<std::array<NodeId, 3>, 2> nodes;
  std::array<std::int8_t, 2> half{};  ///< first or second half, for each
  std::size_t count = 0;
};
TrianglesOfCell parts_of(std::span<const Point> points, Point centre, const std::array<NodeId, 3>& triangle);
TrianglesOfCell parts_of(std::span<const Point> points, Point centre, const std::array<NodeId, 4>& quad);

/// Local cells as triangles: all of them; those that are flagged (triangles, then quads); or those whose
/// boxes meet the squares of some points. *Collective.*
std::vector<CellTriangle> cell_triangles(const Communicator& comm, const Mesh& mesh, Point centre);
std::vector<CellTriangle> cell_triangles(const Communicator& comm, const Mesh& mesh, Point centre,
                                         std::span<const char> flags);
std::vector<CellTriangle> cell_triangles(const Communicator& comm, const Mesh& mesh, Point centre,
                                         const PointCells& points);

}  // namespace quadloop::adapt
