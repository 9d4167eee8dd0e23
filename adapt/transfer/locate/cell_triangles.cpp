#include "adapt/transfer/locate/cell_triangles.hpp"

#include <algorithm>

#include "mesher/delaunay/tie_order.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/box_over_ranks.hpp"

namespace quadloop {

namespace {

int turn_of(const Mesh& mesh, const std::array<NodeId, 3>& nodes) {
  return orientation(mesh.point(nodes[0]), mesh.point(nodes[1]), mesh.point(nodes[2]));
}

/// Along the diagonal from corner `first` to the opposite one.
std::array<std::array<NodeId, 3>, 2> halves(const std::array<NodeId, 4>& quad, std::size_t first) {
  const auto at = [&](std::size_t k) { return quad[(first + k) % 4]; };
  return {{{at(0), at(1), at(2)}, {at(2), at(3), at(0)}}};
}

bool are_counter_clockwise(const Mesh& mesh, const std::array<std::array<NodeId, 3>, 2>& triangles) {
  return turn_of(mesh, triangles[0]) > 0 && turn_of(mesh, triangles[1]) > 0;
}

struct Split {
  std::array<std::array<NodeId, 3>, 2> halves;
  bool are_counter_clockwise = true;
};

/// What split_quad() says, and whether the halves are as they should be.
Split split_of(const Mesh& mesh, Point centre, const std::array<NodeId, 4>& quad) {
  std::array<TieRank, 4> ranks;
  for (std::size_t k = 0; k < 4; ++k) ranks[k] = tie_rank(centre, mesh.point(quad[k]));
  const std::size_t highest = std::max_element(ranks.begin(), ranks.end()) - ranks.begin();
  const auto first = halves(quad, highest);
  if (are_counter_clockwise(mesh, first)) return {first};
  const auto second = halves(quad, highest + 1);
  if (are_counter_clockwise(mesh, second)) return {second};
  return {first, false};
}

void append(const Mesh& mesh, std::array<NodeId, 3> nodes, std::int64_t number,
            std::vector<CellTriangle>& triangles) {
  const int turn = turn_of(mesh, nodes);
  if (turn == 0) return;
  if (turn < 0) std::swap(nodes[1], nodes[2]);
  triangles.push_back({nodes, number});
}

}  // namespace

Point centre_of_nodes(const Communicator& comm, const Mesh& mesh) {
  return box_over_ranks(comm, mesh.points).centre();
}

std::array<std::array<NodeId, 3>, 2> split_quad(const Mesh& mesh, Point centre,
                                                const std::array<NodeId, 4>& quad) {
  return split_of(mesh, centre, quad).halves;
}

std::vector<CellTriangle> cell_triangles(const Communicator& comm, const Mesh& mesh, Point centre) {
  const auto own_triangles = std::ssize(mesh.triangles), own_quads = std::ssize(mesh.quads);
  std::int64_t number = comm.exclusive_sum(own_triangles);
  std::int64_t quad_number = comm.sum(own_triangles) + comm.exclusive_sum(own_quads);
  std::vector<CellTriangle> triangles;
  triangles.reserve(mesh.triangles.size() + 2 * mesh.quads.size());
  for (const auto& nodes : mesh.triangles) append(mesh, nodes, 2 * number++, triangles);
  for (const auto& nodes : mesh.quads) {
    const auto [halves, are_counter_clockwise] = split_of(mesh, centre, nodes);
    for (const std::int64_t half : {0, 1}) {
      if (are_counter_clockwise)
        triangles.push_back({halves[half], 2 * quad_number + half});
      else
        append(mesh, halves[half], 2 * quad_number + half, triangles);
    }
    ++quad_number;
  }
  return triangles;
}

}  // namespace quadloop
