#pragma once

#include <vector>

#include "flow/euler/implicit/colouring.hpp"
#include "flow/euler/implicit/line_system.hpp"
#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/model/flux_jacobian.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"
#include "flow/euler/scheme/no_slip.hpp"
#include "flow/euler/scheme/shock_sensor.hpp"

namespace quadloop::euler {

using Change = std::array<float, 4>;  ///< of what is conserved

/// The linear system of an implicit step: (area / time step + first-order upwind flux matrix) change =
/// -residual, one row of 4 x 4 blocks for each owned node. It is relaxed by coloured Gauss-Seidel sweeps,
/// whose bits do not depend on the number of ranks, in single precision: it only steers the way to the
/// solution. Lines of nodes across stacks of thin cells (LineSystem) are solved as one, in the turn of their
/// colour, and their couplings do not count in their nodes' time steps.
class ImplicitSystem {
 public:
  /// The transposed system has the transposed matrix.
  enum class Sense { forward, transposed };

  /// Both must outlive it. *Collective.*
  ImplicitSystem(const Communicator& comm, const DualMesh& mesh, const FlowModel& model,
                 Sense sense = Sense::forward);

  /// At these states, whose copies are up to date, with each node's own time step: of this CFL number times
  /// the owned node's share. Beside shocks the fluxes are those that the sensor asks for, if there is one.
  void assemble(const std::vector<State>& states, double cfl, const std::vector<double>& shares,
                const ShockSensor* shocks = nullptr);

  /// The same with `rate` in the place of one over the time step, at all nodes.
  void assemble_with_rate(const std::vector<State>& states, double rate, const ShockSensor* shocks = nullptr);

  /// Of each owned node as assembled: area over time step.
  const std::vector<double>& time_terms() const { return time_terms_; }

  /// That many sweeps, every second one through the colours backwards, from zero. `change` has an entry for
  /// each node. *Collective.*
  void relax(const std::vector<Flux>& residual, int sweeps, std::vector<Change>& change);

 private:
  using Block = std::array<float, 16>;  ///< column by column
  /// An edge's blocks in the rows of its nodes: nowhere where another rank has the row, or in the node's
  /// line.
  static constexpr std::int32_t nowhere = -1, in_line = -2;
  struct Slots {
    std::int32_t in_low = nowhere, in_high = nowhere;
  };
  std::int8_t turn(std::int32_t owned_node) const;
  void place(std::int32_t slot, std::int32_t node, std::int32_t other, const Matrix4& block);
  void change_lines(int colour, std::vector<Change>& change);
  void order_rows();
  std::vector<std::size_t> lay_out_rows();
  void place_edges(std::vector<std::size_t> next);
  void add_fluxes(const std::vector<State>& states, const ShockSensor* shocks);
  void add_edges(const std::vector<State>& states, const ShockSensor* shocks);
  void add_faces(const std::vector<State>& states);
  void find_time_terms(double cfl, const std::vector<double>& shares);
  void add_time_terms();
  void invert_diagonal();
  void relax_rows(std::size_t begin, std::size_t end, const std::vector<Flux>& residual,
                  std::vector<Change>& change);

  const DualMesh& mesh_;
  const FlowModel& model_;
  Sense sense_;
  NoSlipNodes no_slip_;
  std::vector<char> held_;  ///< of each node: rows 1 to this one of its block row say what is known
  Colouring colours_;
  LineSystem lines_;
  std::vector<LineSystem::Row> line_rows_;  ///< of right sides
  std::vector<std::int32_t> row_nodes_;     ///< the owned nodes, colour by colour
  std::vector<std::size_t> colour_starts_;  ///< into them
  std::vector<std::size_t> row_starts_;     ///< into the two lists that follow
  std::vector<std::int32_t> columns_;
  std::vector<Block> blocks_;
  std::vector<Slots> slots_;       ///< of each edge
  std::vector<Matrix4> diagonal_;  ///< of each node
  std::vector<Block> inverses_;    ///< of each owned node's diagonal block
  std::vector<double> skewness_;  ///< of each edge: how large what SkewEdge adds to its flux may be, in units
                                  ///< of the flux along the edge
  /// Of each node: half the sum of largest wave speed times size over its faces.
  std::vector<double> wave_sums_;
  std::vector<double> line_sums_;  ///< the same along lines
  std::vector<double> time_terms_;
};

}  // namespace quadloop::euler
