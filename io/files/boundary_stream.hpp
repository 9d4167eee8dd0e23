#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Which of Mesh::boundaries: those with cells on one side and interfaces, inner lines, or all.
enum class EdgeChoice { boundaries, inner_lines, all };

inline bool is_chosen(const BoundaryEdges& boundary, EdgeChoice choice) {
  return choice == EdgeChoice::all || boundary.inner_line == (choice == EdgeChoice::inner_lines);
}

/// The edges of all boundaries in the order in which files have them: boundary after boundary, in each first
/// those of rank 0, then of rank 1, and so on. Each rank has its own edges. The communication does not grow
/// with the number of boundaries: counts are exchanged once.
class BoundaryStream {
 public:
  using Edge = std::array<std::int64_t, 2>;  ///< global node numbers, from 0

  /// The mesh must outlive the object. *Collective.*
  BoundaryStream(const Communicator& comm, const Mesh& mesh, EdgeChoice choice = EdgeChoice::boundaries);
  /// With two other numbers for each chosen edge instead of its nodes. `instead` has two for each boundary
  /// edge of this rank, chosen or not, boundary after boundary.
  BoundaryStream(const Communicator& comm, const Mesh& mesh, std::vector<Edge> instead, EdgeChoice choice);

  EdgeChoice choice() const { return choice_; }
  std::int64_t all_edges() const { return all_edges_; }
  /// The boundaries that have edges on any rank, in their order; and their numbers of edges.
  const std::vector<const BoundaryEdges*>& present() const { return present_; }
  std::int64_t edges_of(std::size_t index) const { return edges_[index]; }

  /// For each boundary of present(), its number of edges on this rank, times `on_each`.
  std::vector<std::int64_t> own_rows(std::int64_t on_each = 1) const;
  /// Returns edge i of those on this rank of a boundary of present().
  Edge own_edge(std::size_t index, std::int64_t i) const;
  /// Number of edges before those, over all boundaries and ranks.
  std::int64_t before_own(std::size_t index) const { return before_own_[index]; }

  /// Returns on rank 0 the edges of each boundary of present(). *Collective.*
  std::vector<std::vector<Edge>> gather(const Communicator& comm) const;

 private:
  const Mesh& mesh_;
  EdgeChoice choice_;
  std::vector<const BoundaryEdges*> present_;
  std::vector<std::int64_t> edges_;       ///< for each of them, over all ranks
  std::vector<std::int64_t> before_own_;  ///< for each of them
  /// Number of this rank's edges of the boundaries before each; the last entry counts all.
  std::vector<std::int64_t> own_before_;
  std::int64_t all_edges_ = 0;
  std::vector<Edge> instead_;
};

}  // namespace quadloop::io
