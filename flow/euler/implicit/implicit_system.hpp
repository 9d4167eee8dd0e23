#pragma once

#include <vector>

#include "flow/euler/implicit/colouring.hpp"
#include "flow/euler/implicit/line_system.hpp"
#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/model/flux_jacobian.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"
#include "flow/euler/scheme/no_slip.hpp"
#include "flow/euler/scheme/shock_sensor.hpp"

namespace quadloop::flow::euler {

using Change = std::array<float, 4>;  ///< of the conserved variables

/// The linear system of an implicit step: (area / time step + first-order upwind flux matrix) change =
/// -residual, one row of 4 x 4 blocks for each owned node. It is relaxed by coloured Gauss-Seidel sweeps,
/// which are bitwise independent of the number of ranks, in single precision, as it affects only the path to
/// the solution. Lines of nodes across stacks of thin cells (LineSystem) are solved together with their
/// colour; their couplings do not enter the time steps of their nodes.
class ImplicitSystem {
 public:
  /// `transposed`: the system with the transposed matrix.
  enum class Sense { forward, transposed };

  /// Mesh and model must outlive the object. *Collective.*
  ImplicitSystem(const Communicator& comm, const DualMesh& mesh, const FlowModel& model,
                 Sense sense = Sense::forward);

  /// Assembles the system at these states (ghosts must be up to date), with local time steps: this CFL number
  /// times the owned node's share. Near shocks the fluxes are those of the sensor, if there is one.
  void assemble(const IdVector<NodeId, State>& states, double cfl, const IdVector<NodeId, double>& shares,
                const ShockSensor* shocks = nullptr);

  /// Assembles with `rate` instead of 1 / time step at all nodes.
  void assemble_with_rate(const IdVector<NodeId, State>& states, double rate,
                          const ShockSensor* shocks = nullptr);

  /// Area / time step of each owned node, as assembled.
  const IdVector<NodeId, double>& time_terms() const { return time_terms_; }

  /// Performs this many sweeps from zero, every second one with the colours in reverse order. `change` has an
  /// entry for each node. *Collective.*
  void relax(const IdVector<NodeId, Flux>& residual, int sweeps, IdVector<NodeId, Change>& change);

 private:
  using Block = std::array<float, 16>;  ///< column-major
  /// An edge's blocks in the rows of its nodes: `nowhere` if another rank has the row, `in_line` if the block
  /// is part of the node's line.
  static constexpr std::int32_t nowhere = -1, in_line = -2;
  struct Slots {
    std::int32_t in_low = nowhere, in_high = nowhere;
  };
  std::int8_t turn(NodeId owned_node) const;
  void place(std::int32_t slot, NodeId node, NodeId other, const Matrix4& block);
  void change_lines(int colour, IdVector<NodeId, Change>& change);
  void order_rows();
  IdVector<NodeId, std::size_t> lay_out_rows();
  void place_edges(IdVector<NodeId, std::size_t> next);
  void add_fluxes(const IdVector<NodeId, State>& states, const ShockSensor* shocks);
  void add_edges(const IdVector<NodeId, State>& states, const ShockSensor* shocks);
  void add_faces(const IdVector<NodeId, State>& states);
  void find_time_terms(double cfl, const IdVector<NodeId, double>& shares);
  void add_time_terms();
  void invert_diagonal();
  void relax_rows(std::size_t begin, std::size_t end, const IdVector<NodeId, Flux>& residual,
                  IdVector<NodeId, Change>& change);

  const DualMesh& mesh_;
  const FlowModel& model_;
  Sense sense_;
  NoSlipNodes no_slip_;
  IdVector<NodeId, char> held_;  ///< for each node: rows 1 to this one of its block row are prescribed
  Colouring colours_;
  LineSystem lines_;
  std::vector<LineSystem::Row> line_rows_;  ///< right sides of the lines
  std::vector<NodeId> row_nodes_;           ///< owned nodes, sorted by colour
  std::vector<std::size_t> colour_starts_;  ///< indices into row_nodes_
  std::vector<std::size_t> row_starts_;     ///< indices into the two vectors below
  std::vector<NodeId> columns_;
  std::vector<Block> blocks_;
  std::vector<Slots> slots_;            ///< for each edge
  IdVector<NodeId, Matrix4> diagonal_;  ///< for each node
  IdVector<NodeId, Block> inverses_;    ///< inverse diagonal block of each owned node
  /// For each edge: bound on the contribution of SkewEdge to its flux, relative to the flux along the edge.
  std::vector<double> skewness_;
  /// For each node: half the sum over its faces of maximum wave speed times face size.
  IdVector<NodeId, double> wave_sums_;
  IdVector<NodeId, double> line_sums_;  ///< the same along lines
  IdVector<NodeId, double> time_terms_;
};

}  // namespace quadloop::flow::euler
