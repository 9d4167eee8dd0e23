#include "mesher/mesh/cells/edge_cells.hpp"

#include <algorithm>
#include <array>
#include <compare>

#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

/// A directed edge and the cell to its left; no cell in a request.
struct DirectedEdge {
  std::int64_t from, to, cell;
  friend auto operator<=>(const DirectedEdge&, const DirectedEdge&) = default;
};

/// Requests to the owner of the edge's lower node for cells that are not on this rank: the cell to the right
/// of an edge, or to the left of a boundary edge.
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

/// Returns the cell to the left of an edge, from sorted edges.
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

/// Fills in what follows from this rank's own cells, and collects requests for the rest.
class OwnEdges {
 public:
  OwnEdges(const Communicator& comm, const Mesh& mesh, EdgeCells& cells)
      : comm_{comm}, mesh_{mesh}, cells_{cells}, owners_(comm, mesh.first_node), table_(mesh) {}

  void fill_across(Questions& questions) const {
    auto at = cells_.across.begin();
    for_each_cell_edge(mesh_, [&](NodeId from, NodeId to, std::int32_t cell) {
      std::int64_t& across = *at++;
      const std::int32_t other = table_.cell_left_of(to, from);
      if (other >= 0) {
        across = number(other);
      } else if (comm_.size() > 1) {
        questions.add(owners_, directed(from, to, number(cell)), across);
      }
    });
  }

  void fill_boundary(Questions& questions) const {
    auto at = cells_.of_boundary.begin();
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      for (const auto& [from, to] : boundary.edges) {
        std::int64_t& left = *at++;
        const std::int32_t own = table_.cell_left_of(from, to);
        if (own >= 0) {
          left = number(own);
        } else {
          questions.add(owners_, directed(from, to, EdgeCells::none), left);
        }
      }
    }
  }

 private:
  std::int64_t number(std::int64_t cell) const {
    const std::int64_t triangles = std::ssize(mesh_.triangles);
    return cell < triangles ? cells_.first_triangle + cell : cells_.first_quad + cell - triangles;
  }
  DirectedEdge directed(NodeId from, NodeId to, std::int64_t cell) const {
    return {mesh_.global(from).value(), mesh_.global(to).value(), cell};
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  EdgeCells& cells_;
  NodeOwners owners_;
  EdgeTable table_;
};

}  // namespace

EdgeCells edge_cells(const Communicator& comm, const Mesh& mesh) {
  const std::int64_t triangles = std::ssize(mesh.triangles);
  std::size_t edges = 0;
  for (const BoundaryEdges& boundary : mesh.boundaries) edges += boundary.edges.size();
  EdgeCells cells;
  cells.first_triangle = comm.exclusive_sum(triangles);
  cells.first_quad = comm.sum(triangles) + comm.exclusive_sum(std::ssize(mesh.quads));
  cells.across.resize(3 * mesh.triangles.size() + 4 * mesh.quads.size(), EdgeCells::none);
  cells.of_boundary.resize(edges, EdgeCells::none);
  Questions questions;
  const OwnEdges own(comm, mesh, cells);
  own.fill_across(questions);
  own.fill_boundary(questions);
  ask(comm, questions);
  return cells;
}

}  // namespace quadloop
