#include "flow/euler/implicit/implicit_system.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <iterator>

#include "flow/euler/scheme/viscous.hpp"

namespace quadloop::flow::euler {

namespace {

/// Converts row-major to column-major.
void store(const Matrix4& matrix, std::array<float, 16>& block) {
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column)
      block[4 * column + row] = static_cast<float>(matrix[4 * row + column]);
  }
}

constexpr double soft_start = 20;  ///< CFL number

using MatrixMap = Eigen::Map<const Eigen::Matrix4f>;  // column-major
using VectorMap = Eigen::Map<const Eigen::Vector4f>;

void add(const Matrix4& matrix, double factor, Matrix4& sum) {
  for (std::size_t k = 0; k < 16; ++k) sum[k] += factor * matrix[k];
}

Matrix4 transposed(const Matrix4& matrix) {
  Matrix4 result;
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) result[4 * column + row] = matrix[4 * row + column];
  }
  return result;
}

/// Adds the viscous derivatives of the flux from low to high with respect to both states. Returns diffusivity
/// times face over distance.
double add_viscous_edge(const FlowModel& model, const DualEdge& edge, const State& low, const State& high,
                        Matrix4& by_low, Matrix4& by_high) {
  const double length_squared = 4 * dot(edge.half, edge.half);
  const double factor = edge.size * std::abs(dot(edge.normal, edge.half)) * 2 / length_squared;
  State mean;
  for (std::size_t k = 0; k < 4; ++k) mean[k] = 0.5 * (low[k] + high[k]);
  add_viscous_matrix(model, low, mean, edge.normal, factor, by_low);
  add_viscous_matrix(model, high, mean, edge.normal, -factor, by_high);
  return factor * diffusivity(model, mean);
}

}  // namespace

ImplicitSystem::ImplicitSystem(const Communicator& comm, const DualMesh& mesh, const FlowModel& model,
                               Sense sense)
    : mesh_{mesh},
      model_{model},
      sense_{sense},
      no_slip_(mesh, model),
      colours_{colour_dual_nodes(comm, mesh)},
      lines_(comm, mesh, colours_),
      line_rows_(lines_.rows()),
      diagonal_(mesh.nodes()),
      inverses_(mesh.owned_nodes()),
      skewness_(mesh.edges().size(), 0.0),
      wave_sums_(mesh.nodes()),
      line_sums_(mesh.nodes()),
      time_terms_(mesh.owned_nodes()) {
  held_ = no_slip_.held_rows(mesh.nodes());
  order_rows();
  place_edges(lay_out_rows());
  for (const SkewEdge& skew : mesh.skew_edges()) {
    const DualEdge& edge = mesh.edges()[skew.edge];
    const double crosswise =
        std::sqrt(dot(skew.with_x, skew.with_x)) + std::sqrt(dot(skew.with_y, skew.with_y));
    skewness_[skew.edge] = crosswise / (2 * std::sqrt(dot(edge.half, edge.half)) * edge.size);
  }
}

/// The colour of the node's update: that of its line, or its own.
std::int8_t ImplicitSystem::turn(NodeId owned_node) const {
  const std::int8_t of_line = lines_.colour(owned_node);
  return of_line >= 0 ? of_line : colours_.colour_of[owned_node];
}

/// Orders the rows by colour. Within a colour the rows of lines come first, as they must not see updates of
/// the same colour, then the others in the order of nodes.
void ImplicitSystem::order_rows() {
  const auto key = [&](NodeId node) { return std::pair{turn(node), lines_.colour(node) < 0}; };
  std::ranges::copy(mesh_.owned_ids(), std::back_inserter(row_nodes_));
  std::stable_sort(row_nodes_.begin(), row_nodes_.end(), [&](NodeId a, NodeId b) { return key(a) < key(b); });
  for (int c = 0; c <= colours_.count; ++c) {
    const auto first = std::partition_point(row_nodes_.begin(), row_nodes_.end(),
                                            [&](NodeId node) { return turn(node) < c; });
    colour_starts_.push_back(first - row_nodes_.begin());
  }
}

/// Reserves a block per neighbour in each row. Returns the start of the row of each owned node.
IdVector<NodeId, std::size_t> ImplicitSystem::lay_out_rows() {
  IdVector<NodeId, std::size_t> neighbours(row_nodes_.size(), 0), starts(row_nodes_.size());
  for (const DualEdge& edge : mesh_.edges()) {
    for (const auto& [node, other] : {std::pair{edge.low, edge.high}, {edge.high, edge.low}}) {
      if (mesh_.is_owned(node) && !lines_.links(node).contains(other)) ++neighbours[node];
    }
  }
  row_starts_.push_back(0);
  for (const NodeId node : row_nodes_) {
    starts[node] = row_starts_.back();
    row_starts_.push_back(row_starts_.back() + neighbours[node]);
  }
  columns_.resize(row_starts_.back());
  blocks_.resize(row_starts_.back());
  return starts;
}

/// Assigns each edge its places in the rows of its nodes, in the order of edges, beginning at `next`, the
/// start of each owned node's row.
void ImplicitSystem::place_edges(IdVector<NodeId, std::size_t> next) {
  const auto take = [&](NodeId node, NodeId column) {
    if (!mesh_.is_owned(node)) return nowhere;
    if (lines_.links(node).contains(column)) return in_line;
    const std::size_t slot = next[node]++;
    columns_[slot] = column;
    return static_cast<std::int32_t>(slot);
  };
  for (const DualEdge& edge : mesh_.edges())
    slots_.push_back({take(edge.low, edge.high), take(edge.high, edge.low)});
}

void ImplicitSystem::assemble(const IdVector<NodeId, State>& states, double cfl,
                              const IdVector<NodeId, double>& shares, const ShockSensor* shocks) {
  add_fluxes(states, shocks);
  find_time_terms(cfl, shares);
  add_time_terms();
  invert_diagonal();
}

void ImplicitSystem::assemble_with_rate(const IdVector<NodeId, State>& states, double rate,
                                        const ShockSensor* shocks) {
  add_fluxes(states, shocks);
  for (const NodeId node : mesh_.owned_ids()) time_terms_[node] = rate * mesh_.areas()[node];
  add_time_terms();
  invert_diagonal();
}

void ImplicitSystem::add_fluxes(const IdVector<NodeId, State>& states, const ShockSensor* shocks) {
  for (Matrix4& block : diagonal_) block = {};
  std::fill(wave_sums_.begin(), wave_sums_.end(), 0.0);
  std::fill(line_sums_.begin(), line_sums_.end(), 0.0);
  add_edges(states, shocks);
  add_faces(states);
}

/// Stores the derivative of the node's row with respect to the other node.
void ImplicitSystem::place(std::int32_t slot, NodeId node, NodeId other, const Matrix4& block) {
  if (slot == nowhere) return;
  Matrix4 kept = block;
  for (int row = 1; row <= held_[node]; ++row) std::fill_n(kept.begin() + 4 * row, 4, 0.0);
  if (slot == in_line) {
    lines_.set_block(node, other, kept);
  } else {
    store(kept, blocks_[slot]);
  }
}

/// The derivative of the flux from low to high is (A_low + |A|) / 2 with respect to the low state and (A_high
/// - |A|) / 2 with respect to the high state.
void ImplicitSystem::add_edges(const IdVector<NodeId, State>& states, const ShockSensor* shocks) {
  const auto edges = mesh_.edges();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const DualEdge& edge = edges[e];
    const NodeId low = edge.low, high = edge.high;
    Matrix4 upwind{};
    const double half = 0.5 * edge.size;
    const double speed = add_upwind_matrix(model_.gas, states[low], states[high], edge.normal, half, upwind,
                                           skewness_[e], shocks ? shocks->share(edge.low, edge.high) : 0);
    Matrix4 by_low = upwind, by_high{};
    add(upwind, -1, by_high);
    add_flux_matrix(model_.gas, states[low], edge.normal, half, by_low);
    add_flux_matrix(model_.gas, states[high], edge.normal, half, by_high);
    double diffusion = 0;
    if (model_.is_viscous())
      diffusion = add_viscous_edge(model_, edge, states[low], states[high], by_low, by_high);
    add(by_low, 1, diagonal_[low]);
    add(by_high, -1, diagonal_[high]);
    for (double& value : by_low) value = -value;
    if (sense_ == Sense::transposed) {
      by_low = transposed(by_low);
      by_high = transposed(by_high);
      std::swap(by_low, by_high);
    }
    place(slots_[e].in_low, edge.low, edge.high, by_high);
    place(slots_[e].in_high, edge.high, edge.low, by_low);
    (slots_[e].in_low == in_line ? line_sums_ : wave_sums_)[low] += half * speed + diffusion;
    (slots_[e].in_high == in_line ? line_sums_ : wave_sums_)[high] += half * speed + diffusion;
  }
}

/// Only the contribution of a node's own state to its half of a face.
void ImplicitSystem::add_faces(const IdVector<NodeId, State>& states) {
  for (const BoundaryFace& face : mesh_.faces()) {
    const BoundaryModel& boundary = model_.boundaries[face.boundary];
    for (const NodeId node : {face.from, face.to}) {
      const State& state = states[node];
      add_boundary_matrix(model_, boundary, state, face.normal, face.half_size, diagonal_[node]);
      const double along = std::abs(state[1] * face.normal.x + state[2] * face.normal.y);
      (lines_.links(node).is_end() ? line_sums_ : wave_sums_)[node] +=
          0.5 * face.half_size * (along + model_.gas.sound_speed(state));
    }
  }
}

/// Waves along lines, which are solved exactly, may travel farther in a step. The first steps are not robust
/// above the CFL number soft_start; later there is no such limit.
void ImplicitSystem::find_time_terms(double cfl, const IdVector<NodeId, double>& shares) {
  const double along = cfl * std::max(1.0, cfl / soft_start);
  for (const NodeId node : mesh_.owned_ids()) {
    double area_over_step = wave_sums_[node] / (cfl * shares[node]);
    if (line_sums_[node] > 0) area_over_step += line_sums_[node] / (along * shares[node]);
    time_terms_[node] = area_over_step;
  }
}

void ImplicitSystem::add_time_terms() {
  for (const NodeId node : mesh_.owned_ids()) {
    for (std::size_t k = 0; k < 4; ++k) diagonal_[node][5 * k] += time_terms_[node];
  }
}

void ImplicitSystem::invert_diagonal() {
  no_slip_.hold(diagonal_);
  if (sense_ == Sense::transposed) std::ranges::transform(diagonal_, diagonal_.begin(), transposed);
  if (!lines_.empty()) lines_.factor(diagonal_);
  for (const NodeId node : mesh_.owned_ids()) {
    using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
    Matrix4 inverse;
    Eigen::Map<Matrix>(inverse.data()) = Eigen::Map<const Matrix>(diagonal_[node].data()).inverse();
    store(inverse, inverses_[node]);
  }
}

void ImplicitSystem::relax(const IdVector<NodeId, Flux>& residual, int sweeps,
                           IdVector<NodeId, Change>& change) {
  for (Change& c : change) c = {};
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (int step = sweep == 0 ? 0 : 1; step < colours_.count;
         ++step) {  // the previous sweep ended with the first colour of this one
      const int colour = sweep % 2 == 0 ? step : colours_.count - 1 - step;
      relax_rows(colour_starts_[colour], colour_starts_[colour + 1], residual, change);
      if (!lines_.empty()) change_lines(colour, change);
      mesh_.update(change, [&](std::int32_t node) { return turn(NodeId{node}) == colour; });
    }
  }
}

void ImplicitSystem::change_lines(int colour, IdVector<NodeId, Change>& change) {
  lines_.solve(colour, line_rows_);
  for (std::size_t row = colour_starts_[colour]; row < colour_starts_[colour + 1]; ++row) {
    const NodeId node = row_nodes_[row];
    if (!lines_.links(node).any()) continue;
    for (std::size_t k = 0; k < 4; ++k) change[node][k] = static_cast<float>(line_rows_[node.value()][k]);
  }
}

void ImplicitSystem::relax_rows(std::size_t begin, std::size_t end, const IdVector<NodeId, Flux>& residual,
                                IdVector<NodeId, Change>& change) {
  for (std::size_t row = begin; row < end; ++row) {
    const NodeId node = row_nodes_[row];
    Eigen::Vector4f right;
    for (int k = 0; k < 4; ++k) right[k] = static_cast<float>(-residual[node][k]);
    for (std::size_t slot = row_starts_[row]; slot < row_starts_[row + 1]; ++slot) {
      right.noalias() -= MatrixMap(blocks_[slot].data()) * VectorMap(change[columns_[slot]].data());
    }
    if (lines_.links(node).any()) {
      Eigen::Map<Eigen::Vector4d>(line_rows_[node.value()].data()) = right.cast<double>();
      continue;
    }
    Eigen::Map<Eigen::Vector4f>(change[node].data()).noalias() = MatrixMap(inverses_[node].data()) * right;
  }
}

}  // namespace quadloop::flow::euler
