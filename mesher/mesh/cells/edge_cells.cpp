#include "mesher/mesh/cells/edge_cells.hpp"

#include <algorithm>
#include <array>
#include <compare>
#include <span>
#include <utility>

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
/// of a cell's edge, or to the left of a boundary edge.
struct Questions {
  std::vector<DirectedEdge> edges;
  std::vector<int> ranks;
  std::vector<std::int64_t*> answers;  ///< null for an edge that is only made known to the owner

  void add(const NodeOwners& owners, const DirectedEdge& edge, std::int64_t* answer) {
    edges.push_back(edge);
    ranks.push_back(owners.rank_of(GlobalNodeId{std::min(edge.from, edge.to)}));
    answers.push_back(answer);
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
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (questions.answers[i] != nullptr) *questions.answers[i] = answers[i];
  }
}

/// Finds what follows from this rank's own cells, and collects requests for the rest.
class OwnEdges {
 public:
  OwnEdges(const Communicator& comm, const Mesh& mesh)
      : comm_{comm},
        mesh_{mesh},
        owners_(comm, mesh.first_node),
        table_(mesh),
        first_triangle_{comm.exclusive_sum(std::ssize(mesh.triangles))},
        first_quad_{comm.sum(std::ssize(mesh.triangles)) + comm.exclusive_sum(std::ssize(mesh.quads))} {}

  std::int64_t first_triangle() const { return first_triangle_; }
  std::int64_t first_quad() const { return first_quad_; }

  void fill_across(std::vector<std::int64_t>& across, Questions& questions) const {
    auto at = across.begin();
    for_each_cell_edge(mesh_, [&](NodeId from, NodeId to, std::int32_t cell) {
      std::int64_t& answer = *at++;
      const std::int32_t other = table_.cell_left_of(to, from);
      if (other >= 0) {
        answer = number(other);
      } else if (comm_.size() > 1) {
        questions.add(owners_, directed(from, to, number(cell)), &answer);
      }
    });
  }

  /// The cells to the left of boundary edges, or to the right if these are turned. *Collective.*
  void fill_boundary(bool turned, std::vector<std::int64_t>& left, Questions& questions) const {
    auto at = left.begin();
    NodeFlags asked(mesh_.points.size(), 0);
    for (const BoundaryEdges& boundary : mesh_.boundaries) {
      for (auto [from, to] : boundary.edges) {
        if (turned) std::swap(from, to);
        std::int64_t& answer = *at++;
        const std::int32_t own = table_.cell_left_of(from, to);
        if (own >= 0) {
          answer = number(own);
        } else if (comm_.size() > 1) {
          questions.add(owners_, directed(from, to, EdgeCells::none), &answer);
          asked[mesh_.global(from) < mesh_.global(to) ? from : to] = 1;
        }
      }
    }
    if (comm_.size() > 1) make_known(asked, questions);
  }

 private:
  /// An edge may be stored on a rank that has neither of its cells, while one rank has both. So all ranks
  /// make their cells' edges at the flagged nodes known to the owners of these. *Collective.*
  void make_known(NodeFlags& asked, Questions& questions) const {
    std::vector<GlobalNodeId> ghosts;
    for_each_flagged(asked, [&](NodeId node) {
      if (!mesh_.owns(node)) ghosts.push_back(mesh_.global(node));
    });
    flag_at_owners(comm_, owners_, ghosts, asked);
    std::span<char> flags(asked.data(), asked.size());
    NodeExchange(comm_, owners_, mesh_.owned_nodes, mesh_.ghosts).update(flags);
    for_each_cell_edge(mesh_, [&](NodeId from, NodeId to, std::int32_t cell) {
      const NodeId lower = mesh_.global(from) < mesh_.global(to) ? from : to;
      if (asked[lower] != 0) questions.add(owners_, directed(from, to, number(cell)), nullptr);
    });
  }

  std::int64_t number(std::int64_t cell) const {
    const std::int64_t triangles = std::ssize(mesh_.triangles);
    return cell < triangles ? first_triangle_ + cell : first_quad_ + cell - triangles;
  }
  DirectedEdge directed(NodeId from, NodeId to, std::int64_t cell) const {
    return {mesh_.global(from).value(), mesh_.global(to).value(), cell};
  }

  const Communicator& comm_;
  const Mesh& mesh_;
  NodeOwners owners_;
  EdgeTable table_;
  std::int64_t first_triangle_, first_quad_;
};

std::size_t boundary_edges(const Mesh& mesh) {
  std::size_t edges = 0;
  for (const BoundaryEdges& boundary : mesh.boundaries) edges += boundary.edges.size();
  return edges;
}

/// The cells to the left of boundary edges, or to the right. *Collective.*
std::vector<std::int64_t> cells_beside_boundaries(const Communicator& comm, const Mesh& mesh, bool right) {
  std::vector<std::int64_t> cells(boundary_edges(mesh), EdgeCells::none);
  Questions questions;
  OwnEdges(comm, mesh).fill_boundary(right, cells, questions);
  ask(comm, questions);
  return cells;
}

}  // namespace

EdgeCells edge_cells(const Communicator& comm, const Mesh& mesh) {
  const OwnEdges own(comm, mesh);
  EdgeCells cells;
  cells.first_triangle = own.first_triangle();
  cells.first_quad = own.first_quad();
  cells.across.resize(3 * mesh.triangles.size() + 4 * mesh.quads.size(), EdgeCells::none);
  cells.of_boundary.resize(boundary_edges(mesh), EdgeCells::none);
  Questions questions;
  own.fill_across(cells.across, questions);
  own.fill_boundary(false, cells.of_boundary, questions);
  ask(comm, questions);
  return cells;
}

std::vector<std::int64_t> cells_left_of_boundaries(const Communicator& comm, const Mesh& mesh) {
  return cells_beside_boundaries(comm, mesh, false);
}

std::vector<std::int64_t> cells_right_of_boundaries(const Communicator& comm, const Mesh& mesh) {
  return cells_beside_boundaries(comm, mesh, true);
}

}  // namespace quadloop
