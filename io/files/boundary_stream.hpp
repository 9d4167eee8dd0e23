#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Which of Mesh::boundaries: those with cells on one side and interfaces, inner lines, or all.
enum class EdgeChoice { boundaries, inner_lines, all };

inline bool is_chosen(const BoundaryEdges& boundary, EdgeChoice choice) {
  return choice == EdgeChoice::all || boundary.inner_line == (choice == EdgeChoice::inner_lines);
}

/// Streams the edges of all boundaries through rank 0: boundary after boundary, in each first those of rank
/// 0, then of rank 1, and so on. The communication does not grow with the number of boundaries: counts are
/// exchanged once, and pieces of edges may span boundaries.
class BoundaryStream {
 public:
  using Edge = std::array<std::int64_t, 2>;  ///< global node numbers, from 0

  /// The mesh must outlive the object. *Collective.*
  BoundaryStream(const Communicator& comm, const Mesh& mesh, EdgeChoice choice = EdgeChoice::boundaries);
  /// Streams two other numbers for each chosen edge instead of its nodes. `instead` has two for each boundary
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

  using Begin = std::function<void(std::size_t index)>;
  using Put = std::function<void(std::span<const Edge> edges)>;
  /// On rank 0, for each boundary with edges, calls `begin(n)` with its index in present(), then
  /// `put(std::span<const Edge>)` for each piece. An exception in either ends the call on every rank, without
  /// deadlock. *Collective.*
  void run(const Begin& begin, const Put& put) const;

 private:
  /// Edges of one boundary on one rank.
  struct Share {
    std::int64_t boundary, rank, edges;
  };

  /// Edges being received from one rank: the current piece, and how much of it has been used.
  struct Incoming {
    std::vector<Edge> piece;
    std::size_t taken = 0;
    std::int64_t asked_for = 0, all = 0;  ///< numbers of edges
  };

  void take_all(const Begin& begin, const Put& put) const;
  void take_share(const Share& share, Incoming& from, const Put& put) const;
  std::vector<Incoming> all_incoming() const;
  void ask_for_next(int rank, Incoming& from) const;
  void receive_rest(int rank, Incoming& from) const;
  void send_all() const;
  std::vector<Edge> own_piece(std::int64_t first) const;

  const Communicator& comm_;
  const Mesh& mesh_;
  EdgeChoice choice_;
  std::vector<const BoundaryEdges*> present_;
  std::vector<std::int64_t> edges_;       ///< for each of them, over all ranks
  std::vector<std::int64_t> before_own_;  ///< for each of them
  /// Number of this rank's edges of the boundaries before each; the last entry counts all.
  std::vector<std::int64_t> own_before_;
  std::vector<Share> shares_;  ///< on rank 0: by boundary, then rank
  std::int64_t all_edges_ = 0;
  std::vector<Edge> instead_;
};

}  // namespace quadloop::io
