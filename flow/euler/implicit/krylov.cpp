#include "flow/euler/implicit/krylov.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::flow::euler {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(),
                 not_a_number = std::numeric_limits<double>::quiet_NaN();

/// One cycle between restarts.
class Gmres {
 public:
  Gmres(const Communicator& comm, const KrylovSystem& system, int steps)
      : comm_{comm}, system_{system}, steps_{steps}, nodes_{comm.sum(std::int64_t{system.owned})} {}

  double dot(const NodeRows& a, const NodeRows& b) const {
    IdVector<NodeId, double> terms(system_.owned);
    for (const NodeId i : terms.ids())
      terms[i] = a[i][0] * b[i][0] + a[i][1] * b[i][1] + (a[i][2] * b[i][2] + a[i][3] * b[i][3]);
    return reproducible_sum(comm_, terms);
  }
  double norm(const NodeRows& a) const { return std::sqrt(dot(a, a)); }

  /// Improves x in the Krylov space of the remaining right side `left`, until the residual norm is below
  /// `enough`. Returns the number of steps.
  int improve(const NodeRows& left, double enough, NodeRows& x) {
    basis_.assign(1, left);
    steps_taken_.clear();
    columns_.clear();
    rotations_.clear();
    const double size = norm(left);
    scale(1 / size, basis_[0]);
    rest_.assign(1, size);
    while (static_cast<int>(columns_.size()) < steps_ && std::abs(rest_.back()) > enough) {
      extend();
      if (!std::isfinite(rest_.back())) break;
    }
    add_steps(x);
    return static_cast<int>(columns_.size());
  }

 private:
  using Column = std::vector<double>;

  static void scale(double factor, NodeRows& a) {
    for (auto& row : a) {
      for (double& value : row) value *= factor;
    }
  }
  static void add(double factor, const NodeRows& a, NodeRows& sum) {
    for (const NodeId i : a.ids()) {
      for (std::size_t k = 0; k < 4; ++k) sum[i][k] += factor * a[i][k];
    }
  }

  /// Scalar products of `a` with the basis, and with itself as the last, in a single reduction. NaN if `a` is
  /// not finite.
  Column products(const NodeRows& a) const {
    double largest = 0;
    for (const NodeId i : ids_below(NodeId{system_.owned})) {
      for (const double value : a[i])
        largest = std::isfinite(value) ? std::max(largest, std::abs(value)) : infinity;
      if (largest == infinity) break;
    }
    largest = comm_.maximum(largest);
    if (largest == 0 || largest == infinity)
      return Column(basis_.size() + 1, largest == 0 ? 0 : not_a_number);
    // entries divided by it are below 2
    const double size = std::ldexp(1, std::ilogb(largest)), down = 1 / size;
    ReproducibleSums sums(basis_.size() + 1, 16, nodes_);
    for (std::size_t j = 0; j <= basis_.size(); ++j) {
      const NodeRows& b = j < basis_.size() ? basis_[j] : a;
      const double scale = j < basis_.size() ? down : down * down;
      for (const NodeId i : ids_below(NodeId{system_.owned}))
        sums.add(j,
                 scale * (a[i][0] * b[i][0] + a[i][1] * b[i][1] + (a[i][2] * b[i][2] + a[i][3] * b[i][3])));
    }
    Column found = sums.over(comm_);
    for (double& value : found) value *= size;
    found.back() *= size;
    return found;
  }

  /// Orthogonalises `a` against the basis, twice because of rounding (Giraud and others 2005). Returns the
  /// coefficients and the norm of the rest.
  Column orthogonalise(NodeRows& a) const {
    Column taken(basis_.size() + 1, 0.0);
    double square = 0;
    for (int pass = 0; pass < 2; ++pass) {
      const Column found = products(a);
      square = found.back();
      for (std::size_t j = 0; j < basis_.size(); ++j) {
        taken[j] += found[j];
        square -= found[j] * found[j];
        add(-found[j], basis_[j], a);
      }
    }
    taken.back() = square > 0 ? std::sqrt(square) : square * 0;
    return taken;
  }

  /// Adds a basis vector, and the Givens rotation that keeps the matrix triangular.
  void extend() {
    NodeRows step(basis_.back().size()), product;
    system_.precondition(basis_.back(), step);
    system_.multiply(step, product);
    Column column = orthogonalise(product);
    const double size = column.back();
    column.pop_back();
    for (std::size_t i = 0; i < rotations_.size(); ++i) {
      const auto [c, s] = rotations_[i];
      const double upper = column[i], lower = column[i + 1];
      column[i] = c * upper + s * lower;
      column[i + 1] = c * lower - s * upper;
    }
    const double length = std::sqrt(column.back() * column.back() + size * size);
    const double c = length > 0 ? column.back() / length : 1, s = length > 0 ? size / length : 0;
    rotations_.push_back({c, s});
    column.back() = length;
    columns_.push_back(std::move(column));
    const double last = rest_.back();
    rest_.back() = c * last;
    rest_.push_back(-s * last);
    steps_taken_.push_back(std::move(step));
    if (size > 0) scale(1 / size, product);
    basis_.push_back(std::move(product));
  }

  void add_steps(NodeRows& x) const {
    Column factors(columns_.size());
    for (std::size_t i = columns_.size(); i-- > 0;) {
      double sum = rest_[i];
      for (std::size_t j = i + 1; j < columns_.size(); ++j) sum -= columns_[j][i] * factors[j];
      factors[i] = columns_[i][i] != 0 ? sum / columns_[i][i] : 0;
    }
    for (std::size_t i = 0; i < factors.size(); ++i) add(factors[i], steps_taken_[i], x);
  }

  const Communicator& comm_;
  const KrylovSystem& system_;
  int steps_;
  std::int64_t nodes_;  ///< over all ranks
  std::vector<NodeRows> basis_, steps_taken_;
  std::vector<Column> columns_;                   ///< of the upper triangular matrix
  std::vector<std::array<double, 2>> rotations_;  ///< cosines and sines
  Column rest_;                                   ///< right side in the basis
};

}  // namespace

KrylovEnd solve_by_gmres(const Communicator& comm, const KrylovSystem& system, const NodeRows& right,
                         NodeRows& x, double tolerance, int iterations, int restart) {
  Gmres gmres(comm, system, restart);
  x = NodeRows(right.size());
  const double whole = gmres.norm(right);
  KrylovEnd end;
  if (whole == 0) return end;
  NodeRows left = right;
  end.residual = 1;
  while (end.iterations < iterations && end.residual > tolerance) {
    end.iterations += gmres.improve(left, 0.5 * tolerance * whole, x);
    NodeRows product;
    system.multiply(x, product);
    for (const NodeId i : left.ids()) {
      for (std::size_t k = 0; k < 4; ++k) left[i][k] = right[i][k] - product[i][k];
    }
    const double before = end.residual;
    end.residual = gmres.norm(left) / whole;
    if (!(end.residual < 0.999 * before)) break;  // no further progress
  }
  return end;
}

}  // namespace quadloop::flow::euler
