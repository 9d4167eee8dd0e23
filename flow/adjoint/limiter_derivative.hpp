#pragma once

#include <array>
#include <vector>

#include "flow/euler/scheme/reconstruction.hpp"

namespace quadloop::euler {

/// How the limited gradients answer to states and gradients. Where a factor hangs on the largest or smallest
/// value, or change, among a node's edges, on that of the first such edge alone. Factors that are kept answer
/// to nothing.
class LimiterDerivative {
 public:
  /// Of the limiter's last call, at these states and these gradients, which are not limited. The mesh must
  /// outlive it.
  LimiterDerivative(const DualMesh& mesh, const Limiter& limiter, const std::vector<State>& states,
                    std::vector<Gradient> gradients);

  /// Turns the owned nodes' changes of gradients into those of limited ones. The changes of states must have
  /// copies.
  void apply(const std::vector<State>& change, std::vector<Gradient>& gradients) const;

  /// The transpose: turns weights of the owned nodes' limited gradients into those of gradients, and adds
  /// what is left to the owned nodes' `sums`, of states. *Collective.*
  void apply_transposed(std::vector<Gradient>& weights, std::vector<State>& sums) const;

  /// What weights of the owned nodes' limited gradients make of the places of nodes and of the owned nodes'
  /// areas, as far as the factors follow these: adds to the owned nodes' sums. *Collective.*
  void add_place_weights(const std::vector<Gradient>& weights, std::vector<Point>& places,
                         std::vector<double>& areas) const;

 private:
  /// Of one variable at one node.
  struct Part {
    double factor = 1;
    double by_allowed = 0, by_change = 0;  ///< derivatives, with the sign of the side that decides
    double by_small = 0;                   ///< by the square of what is small
    double by_own = 0;                     ///< by the node's own value, of which it must keep some
    std::int32_t neighbour = -1;           ///< that has the value that decides
    std::int32_t along = -1;               ///< the neighbour along the edge whose change decides
    Point way;                             ///< to that edge's middle
  };
  struct Side;
  void find(const Limiter& limiter, const std::vector<State>& states);
  void follow_bounds(const Limiter& limiter, std::size_t node, std::size_t k, double value, const Side& up,
                     const Side& down);
  void follow_keeping(const Limiter& limiter, std::size_t node, std::size_t k, double value,
                      const Side& down);
  void find_edges(const Limiter& limiter, const std::vector<State>& states, std::vector<Side>& sides) const;

  const DualMesh& mesh_;
  std::vector<Gradient> gradients_;
  std::vector<std::array<Part, 4>> parts_;  ///< of the owned nodes
  std::vector<double> small_squared_;       ///< likewise
  bool live_;
};

}  // namespace quadloop::euler
