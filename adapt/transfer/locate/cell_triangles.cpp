#include "adapt/transfer/locate/cell_triangles.hpp"

#include <algorithm>

#include "mesher/delaunay/tie_order.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/box_over_ranks.hpp"

namespace quadloop::adapt {

namespace {

using Points = std::span<const Point>;  ///< by node

template <std::size_t width>
std::array<Point, width> corners_at(Points points, const std::array<NodeId, width>& nodes) {
  std::array<Point, width> corners;
  for (std::size_t k = 0; k < width; ++k) corners[k] = points[nodes[k].value()];
  return corners;
}

int turn_of(Points points, const std::array<NodeId, 3>& nodes) {
  const auto [a, b, c] = corners_at(points, nodes);
  return orientation(a, b, c);
}

/// Splits along the diagonal from corner `first` to the opposite one.
std::array<std::array<NodeId, 3>, 2> halves(const std::array<NodeId, 4>& quad, std::size_t first) {
  const auto at = [&](std::size_t k) { return quad[(first + k) % 4]; };
  return {{{at(0), at(1), at(2)}, {at(2), at(3), at(0)}}};
}

bool are_counter_clockwise(Points points, const std::array<std::array<NodeId, 3>, 2>& triangles) {
  return turn_of(points, triangles[0]) > 0 && turn_of(points, triangles[1]) > 0;
}

/// The corner of the highest tie_rank().
std::size_t highest_corner(Point centre, const std::array<Point, 4>& corners) {
  struct Rank {
    double farther, nearer, x, y;
    bool below(const Rank& other) const {
      if (farther != other.farther) return farther < other.farther;
      if (nearer != other.nearer) return nearer < other.nearer;
      return x != other.x ? x < other.x : y < other.y;
    }
  };
  const auto rank_of = [centre](Point p) {
    const TieRank rank = tie_rank(centre, p);
    return Rank{rank.farther, rank.nearer, rank.x, rank.y};
  };
  std::size_t highest = 0;
  Rank best = rank_of(corners[0]);
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Rank other = rank_of(corners[k]);
    if (!best.below(other)) continue;
    best = other;
    highest = k;
  }
  return highest;
}

struct Split {
  std::array<std::array<NodeId, 3>, 2> halves;
  bool are_counter_clockwise = true;
};

/// The halves of a quad, and whether they are as they should be.
Split split_of(Points points, Point centre, const std::array<NodeId, 4>& quad) {
  const std::array<Point, 4> corners = corners_at(points, quad);
  if (is_rectangle(corners)) return {halves(quad, farthest_corner(centre, corners))};
  const std::size_t highest = highest_corner(centre, corners);
  const auto first = halves(quad, highest);
  if (are_counter_clockwise(points, first)) return {first};
  const auto second = halves(quad, highest + 1);
  if (are_counter_clockwise(points, second)) return {second};
  return {first, false};
}

void append(Points points, std::array<NodeId, 3> nodes, std::int8_t half, TrianglesOfCell& parts) {
  const int turn = turn_of(points, nodes);
  if (turn == 0) return;
  if (turn < 0) std::swap(nodes[1], nodes[2]);
  parts.half[parts.count] = half;
  parts.nodes[parts.count++] = nodes;
}

template <class Cells>
Box box_of_cell(const Mesh& mesh, const Cells& cells, std::size_t cell) {
  Box box;
  for (const NodeId node : cells[cell]) box.include(mesh.point(node));
  return box;
}

/// Appends the triangles of the cells that `for_each_wanted(cells, visit)` visits, for each kind of cells.
/// *Collective.*
template <class ForEachWanted>
void append_all(const Communicator& comm, const Mesh& mesh, Point centre,
                const ForEachWanted& for_each_wanted, std::vector<CellTriangle>& triangles) {
  const auto append_of = [&](const auto& cells, std::int64_t first) {
    for_each_wanted(cells, [&](std::size_t cell) {
      const TrianglesOfCell parts = parts_of(mesh.points, centre, cells[cell]);
      const std::int64_t number = first + static_cast<std::int64_t>(cell);
      for (std::size_t k = 0; k < parts.count; ++k)
        triangles.push_back({parts.nodes[k], 2 * number + parts.half[k]});
    });
  };
  const auto own_triangles = std::ssize(mesh.triangles), own_quads = std::ssize(mesh.quads);
  append_of(mesh.triangles, comm.exclusive_sum(own_triangles));
  append_of(mesh.quads, comm.sum(own_triangles) + comm.exclusive_sum(own_quads));
}

}  // namespace

Point centre_of_nodes(const Communicator& comm, const Mesh& mesh) {
  return box_over_ranks(comm, mesh.points).centre();
}

TrianglesOfCell parts_of(Points points, Point, const std::array<NodeId, 3>& triangle) {
  TrianglesOfCell parts;
  append(points, triangle, 0, parts);
  return parts;
}

TrianglesOfCell parts_of(Points points, Point centre, const std::array<NodeId, 4>& quad) {
  const auto [halves, are_counter_clockwise] = split_of(points, centre, quad);
  if (are_counter_clockwise) return {halves, {0, 1}, 2};
  TrianglesOfCell parts;
  append(points, halves[0], 0, parts);
  append(points, halves[1], 1, parts);
  return parts;
}

std::vector<CellTriangle> cell_triangles(const Communicator& comm, const Mesh& mesh, Point centre) {
  std::vector<CellTriangle> triangles;
  triangles.reserve(mesh.triangles.size() + 2 * mesh.quads.size());
  const auto every = [](const auto& cells, const auto& visit) {
    for (std::size_t cell = 0; cell < cells.size(); ++cell) visit(cell);
  };
  append_all(comm, mesh, centre, every, triangles);
  return triangles;
}

std::vector<CellTriangle> cell_triangles(const Communicator& comm, const Mesh& mesh, Point centre,
                                         std::span<const char> flags) {
  std::vector<CellTriangle> triangles;
  std::size_t before = 0;  // cells of the kinds before
  const auto flagged = [&](const auto& cells, const auto& visit) {
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
      if (flags[before + cell] != 0) visit(cell);
    }
    before += cells.size();
  };
  append_all(comm, mesh, centre, flagged, triangles);
  return triangles;
}

std::vector<CellTriangle> cell_triangles(const Communicator& comm, const Mesh& mesh, Point centre,
                                         const PointCells& points) {
  std::vector<CellTriangle> triangles;
  const auto near = [&](const auto& cells, const auto& visit) {
    points.for_each_met(
        cells.size(), [&](std::size_t cell) { return box_of_cell(mesh, cells, cell); }, visit);
  };
  append_all(comm, mesh, centre, near, triangles);
  return triangles;
}

}  // namespace quadloop::adapt
