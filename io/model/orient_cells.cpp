#include "io/model/orient_cells.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <tuple>
#include <vector>

#include "mesher/base/parity_sets.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop::io {

namespace {

/// An edge of a cell.
struct EdgeOfCell {
  NodeId low, high;
  std::int32_t cell;
  bool rising;  ///< whether the cell traverses it from low to high

  bool same_edge(const EdgeOfCell& other) const { return low == other.low && high == other.high; }
};

/// Sides of the same edge are adjacent.
std::vector<EdgeOfCell> sorted_edges(const Mesh& mesh) {
  std::vector<EdgeOfCell> sides;
  sides.reserve(3 * mesh.triangles.size() + 4 * mesh.quads.size());
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    if (from != to) sides.push_back({std::min(from, to), std::max(from, to), cell, from < to});
  });
  std::sort(sides.begin(), sides.end(), [](const EdgeOfCell& a, const EdgeOfCell& b) {
    return std::tie(a.low, a.high, a.cell, a.rising) < std::tie(b.low, b.high, b.cell, b.rising);
  });
  return sides;
}

ParitySets pieces_of(const Mesh& mesh) {
  ParitySets pieces(mesh.cell_count());
  const std::vector<EdgeOfCell> sides = sorted_edges(mesh);
  for (auto first = sides.begin(); first != sides.end();) {
    const auto end =
        std::find_if(first, sides.end(), [&](const EdgeOfCell& side) { return !side.same_edge(*first); });
    if (end - first == 2) pieces.join(first[0].cell, first[1].cell, first[0].rising == first[1].rising);
    first = end;
  }
  return pieces;
}

double twice_area(const Mesh& mesh, const std::array<NodeId, 3>& nodes) {
  const Point a = mesh.point(nodes[0]);
  return cross(mesh.point(nodes[1]) - a, mesh.point(nodes[2]) - a);
}

double twice_area(const Mesh& mesh, const std::array<NodeId, 4>& nodes) {
  return cross(mesh.point(nodes[2]) - mesh.point(nodes[0]), mesh.point(nodes[3]) - mesh.point(nodes[1]));
}

/// Calls `visit(nodes, cell)` for every cell, numbered triangles first, then quads.
template <class AnyMesh, class Visit>
void for_each_plane_cell(AnyMesh& mesh, const Visit& visit) {
  std::size_t cell = 0;
  mesh.for_each_cell([&](auto& nodes) { visit(nodes, cell++); });
}

/// Returns for each root twice the signed area of its component, for the root's present orientation.
std::vector<double> areas_of(const Mesh& mesh, ParitySets& pieces) {
  std::vector<double> areas(mesh.cell_count(), 0);
  for_each_plane_cell(mesh, [&](const auto& nodes, std::size_t cell) {
    const auto [root, opposed] = pieces.member_of(cell);
    const double area = twice_area(mesh, nodes);
    areas[root] += opposed ? -area : area;
  });
  return areas;
}

/// Whether cells of two ranks have the same directed edge. Both its nodes are then flagged: cells of a rank
/// that does not own them use them. The owner of the lower node compares. *Collective.*
bool repeats_over_ranks(const Communicator& comm, const Mesh& mesh) {
  const NodeOwners owners(comm, mesh.first_node);
  NodeFlags shared(mesh.points.size(), 0);
  flag_at_owners(comm, owners, mesh.ghosts, shared);
  std::span<char> flags(shared.data(), shared.size());
  NodeExchange(comm, owners, mesh.owned_nodes, mesh.ghosts).update(flags);
  std::vector<std::array<GlobalNodeId, 2>> edges;
  std::vector<int> ranks;
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t) {
    if (shared[from] == 0 || shared[to] == 0) return;
    edges.push_back({mesh.global(from), mesh.global(to)});
    ranks.push_back(owners.rank_of(std::min(edges.back()[0], edges.back()[1])));
  });
  auto arrived = Exchange(comm, ranks).deliver(edges);
  std::ranges::sort(arrived);
  return comm.any(std::ranges::adjacent_find(arrived) != arrived.end());
}

}  // namespace

bool surely_oriented(const Mesh& mesh, const EdgeTable& table) {
  const auto runs_left = [&](const auto& nodes) { return twice_area(mesh, nodes) > 0; };
  return std::ranges::all_of(mesh.triangles, runs_left) && std::ranges::all_of(mesh.quads, runs_left) &&
         !table.repeats();
}

bool surely_oriented(const Communicator& comm, const Mesh& mesh) {
  if (comm.any(!surely_oriented(mesh, EdgeTable(mesh)))) return false;
  return comm.size() == 1 || !repeats_over_ranks(comm, mesh);
}

std::int64_t orient_cells(Mesh& mesh) {
  ParitySets pieces = pieces_of(mesh);
  const std::vector<double> areas = areas_of(mesh, pieces);
  std::int64_t turned = 0;
  for_each_plane_cell(mesh, [&](auto& nodes, std::size_t cell) {
    const auto [root, opposed] = pieces.member_of(cell);
    const double area = opposed ? -areas[root] : areas[root];
    if (!(area < 0) || pieces.is_torn(root)) return;  // a NaN area reverses nothing
    std::reverse(nodes.begin() + 1, nodes.end());
    ++turned;
  });
  return turned;
}

}  // namespace quadloop::io
