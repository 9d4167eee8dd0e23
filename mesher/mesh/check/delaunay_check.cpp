#include "mesher/mesh/check/delaunay_check.hpp"

#include <mpi.h>

#include <algorithm>
#include <array>
#include <vector>

#include "mesher/geometry/blunt_corners.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/check/cell_pairs.hpp"
#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop {

namespace {

using Edge = std::array<NodeId, 2>;

Edge undirected(NodeId a, NodeId b) { return {std::min(a, b), std::max(a, b)}; }

/// The edges of inner lines at this rank's nodes, ascending.
std::vector<Edge> edges_of_lines(const HaloMesh& halo, const Mesh& mesh) {
  std::vector<Edge> edges;
  for (const HaloEdge& edge : halo.boundary_edges()) {
    if (mesh.boundaries[edge.boundary].inner_line) edges.push_back(undirected(edge.from, edge.to));
  }
  std::ranges::sort(edges);
  return edges;
}

/// A triangle and its block.
struct Sided {
  std::array<NodeId, 3> nodes;
  std::int32_t block;
};

/// Whether the third node of one triangle at an edge is inside the circle of the other. Exact, so it does not
/// matter whose circle is taken.
bool is_inside_circle(const HaloMesh& halo, NodeId from, NodeId to, const Sided& triangle,
                      const Sided& other) {
  const auto p = corners_of(halo, triangle.nodes);
  return std::ranges::any_of(other.nodes, [&](NodeId node) {
    return node != from && node != to && in_circle(p[0], p[1], p[2], halo.point(node)) > 0;
  });
}

/// Whether a triangle's angle opposite to an edge is obtuse.
bool is_blunt(const HaloMesh& halo, NodeId from, NodeId to, const Sided& triangle) {
  const auto [a, b, c] = corners_of(halo, triangle.nodes);
  const unsigned blunt = blunt_corners(a, b, c);
  for (unsigned k = 0; k < 3; ++k) {
    const NodeId node = triangle.nodes[k];
    if (node != from && node != to) return (blunt >> k & 1U) != 0;
  }
  return false;
}

/// *Collective.*
bool all_edges_delaunay(const Communicator& comm, const Mesh& mesh,
                        std::span<const std::int32_t> triangle_to_block) {
  const HaloMesh halo(comm, mesh);
  std::vector<std::int32_t> blocks(triangle_to_block.begin(), triangle_to_block.end());
  blocks.resize(mesh.triangles.size(), 0);
  blocks = halo.spread(comm, blocks);
  const std::vector<Edge> of_lines = edges_of_lines(halo, mesh);
  bool all = true;
  CellPairs<Sided> pairs(halo, [](NodeId) { return true; });
  pairs.for_each(
      [&]<std::size_t width>(const std::array<NodeId, width>& nodes, std::int32_t number) {
        return Sided{{nodes[0], nodes[1], nodes[2]}, blocks[number]};
      },
      [&](NodeId from, NodeId to, const Sided& a, const Sided& b) {
        // An edge that is not Delaunay is opposite an obtuse corner of one of its triangles.
        if (!all || a.block != b.block || !(is_blunt(halo, from, to, a) || is_blunt(halo, from, to, b)))
          return;
        if (std::ranges::binary_search(of_lines, undirected(from, to))) return;
        all = !is_inside_circle(halo, from, to, a, b);
      });
  return all;
}

}  // namespace

bool is_delaunay(const Communicator& comm, const Mesh& mesh,
                 std::span<const std::int32_t> triangle_to_block) {
  const bool sound = mesh.quads.empty() && std::ranges::all_of(mesh.triangles, [&](const auto& nodes) {
                       const auto [a, b, c] = corners_of(mesh, nodes);
                       return orientation(a, b, c) > 0;
                     });
  if (comm.any(!sound) || comm.sum(std::ssize(mesh.triangles)) == 0) return false;
  return !comm.any(!all_edges_delaunay(comm, mesh, triangle_to_block));
}

bool is_delaunay(const Mesh& whole, std::span<const std::int32_t> triangle_to_block) {
  return is_delaunay(Communicator(MPI_COMM_SELF), whole, triangle_to_block);
}

}  // namespace quadloop
