#include "mesher/solid/edge_cells.hpp"

#include <algorithm>
#include <array>
#include <compare>

#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

/// A directed edge and the cell to its left; none where a rank only asks for it.
struct DirectedEdge {
  std::int64_t from, to, cell;
  friend auto operator<=>(const DirectedEdge&, const DirectedEdge&) = default;
};

/// What this rank's own cells do not tell, asked of the rank that owns the edge's lower node: of each edge
/// the cell to its right, of a boundary edge that to its left.
struct Questions {
  std::vector<DirectedEdge> edges;
  std::vector<int> ranks;
  std::vector<std::int64_t*> answers;

  void add(const NodeOwners& owners, const DirectedEdge& edge, std::int64_t& answer) {
    edges.push_back(edge);
    ranks.push_back(owners.rank_of(GlobalNodeId{std::min(edge.from, edge.to)}));
    answers.push_back(&answer);
  }
};

/// The cell to the left of an edge among sorted ones.
std::int64_t cell_left_of(const std::vector<DirectedEdge>& sorted, std::int64_t from, std::int64_t to) {
  const auto found = std::ranges::lower_bound(sorted, DirectedEdge{from, to, 0});
  return found != sorted.end() && found->from == from && found->to == to ? found->cell : EdgeCells::none;
}

/// *Collective.*
void ask(const Communicator& comm, const Questions& questions) {
  const Exchange exchange(comm, questions.ranks);
  const std::vector<DirectedEdge> asked = exchange.deliver(questions.edges);
  std::vector<DirectedEdge> sorted = asked;
  std::ranges::sort(sorted);
  std::vector<std::int64_t> answers;
  for (const DirectedEdge& edge : asked) {
    answers.push_back(edge.cell == EdgeCells::none ? cell_left_of(sorted, edge.from, edge.to)
                                                   : cell_left_of(sorted, edge.to, edge.from));
  }
  answers = exchange.answer(answers);
  for (std::size_t i = 0; i < answers.size(); ++i) *questions.answers[i] = answers[i];
}

}  // namespace

EdgeCells edge_cells(const Communicator& comm, const Mesh& mesh) {
  const EdgeTable table(mesh);
  const NodeOwners owners(comm, mesh.first_node);
  const std::int64_t triangles = std::ssize(mesh.triangles);
  EdgeCells cells;
  cells.first_triangle = comm.exclusive_sum(triangles);
  cells.first_quad = comm.sum(triangles) + comm.exclusive_sum(std::ssize(mesh.quads));
  const auto number = [&](std::int64_t cell) {
    return cell < triangles ? cells.first_triangle + cell : cells.first_quad + cell - triangles;
  };
  cells.across.resize(3 * mesh.triangles.size() + 4 * mesh.quads.size(), EdgeCells::none);
  Questions questions;
  std::size_t at = 0;
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    std::int64_t& across = cells.across[at++];
    const std::int32_t other = table.cell_left_of(to, from);
    if (other >= 0) {
      across = number(other);
    } else if (comm.size() > 1) {
      questions.add(owners, {mesh.global(from).value(), mesh.global(to).value(), number(cell)}, across);
    }
  });
  std::size_t edges = 0;
  for (const BoundaryEdges& boundary : mesh.boundaries) edges += boundary.edges.size();
  cells.of_boundary.resize(edges, EdgeCells::none);
  at = 0;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& [from, to] : boundary.edges) {
      std::int64_t& left = cells.of_boundary[at++];
      const std::int32_t own = table.cell_left_of(from, to);
      if (own >= 0) {
        left = number(own);
      } else {
        questions.add(owners, {mesh.global(from).value(), mesh.global(to).value(), EdgeCells::none}, left);
      }
    }
  }
  ask(comm, questions);
  return cells;
}

}  // namespace quadloop
