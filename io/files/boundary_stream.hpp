#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The edges of all boundaries as they pass through rank 0: boundary after boundary, of each first rank 0's,
/// then rank 1's, and so on. What ranks say to each other does not grow with the number of boundaries: counts
/// go round once, edges come in pieces that span boundaries.
class BoundaryStream {
 public:
  using Edge = std::array<std::int64_t, 2>;  ///< global numbers of its nodes, from 0

  /// *Collective.* The mesh must outlive it.
  BoundaryStream(const Communicator& comm, const Mesh& mesh);
  /// Of each edge two other numbers in the place of its nodes' own: this rank's edges, boundary after
  /// boundary.
  BoundaryStream(const Communicator& comm, const Mesh& mesh, std::vector<Edge> instead);

  std::int64_t all_edges() const { return all_edges_; }
  /// The boundaries that have edges on any rank, in their order; and how many.
  const std::vector<const BoundaryEdges*>& present() const { return present_; }
  std::int64_t edges_of(std::size_t index) const { return edges_[index]; }

  using Begin = std::function<void(std::size_t index)>;
  using Put = std::function<void(std::span<const Edge> edges)>;
  /// On rank 0, for each boundary that has edges, `begin(n)` with its index in present(), then
  /// `put(std::span<const Edge>)` for each piece of it. *Collective*; what either throws ends on every rank,
  /// and nobody hangs.
  void run(const Begin& begin, const Put& put) const;

 private:
  /// Edges of one boundary on one rank.
  struct Share {
    std::int64_t boundary, rank, edges;
  };

  /// One rank's edges on their way: the piece under way, and what of it was handed on.
  struct Incoming {
    std::vector<Edge> piece;
    std::size_t taken = 0;
    std::int64_t asked_for = 0, all = 0;  ///< edges
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
  std::vector<const BoundaryEdges*> present_;
  std::vector<std::int64_t> edges_;  ///< of each of them, over all ranks
  /// This rank's edges of the boundaries before each; the last entry is all of them.
  std::vector<std::int64_t> own_before_;
  std::vector<Share> shares_;  ///< on rank 0: by boundary, then rank
  std::int64_t all_edges_ = 0;
  std::vector<Edge> instead_;
};

}  // namespace quadloop
