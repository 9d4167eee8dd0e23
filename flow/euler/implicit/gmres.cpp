#include "flow/euler/implicit/gmres.hpp"

#include <cmath>

#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::euler {

namespace {

void scale(double factor, Gmres::Vector& vector) {
  for (Flux& entry : vector) {
    for (double& value : entry) value *= factor;
  }
}

/// sum += factor * vector
template <class Vector>
void add(double factor, const Vector& vector, Gmres::Vector& sum) {
  for (std::size_t node = 0; node < sum.size(); ++node) {
    for (std::size_t k = 0; k < 4; ++k) sum[node][k] += factor * static_cast<double>(vector[node][k]);
  }
}

}  // namespace

Gmres::Gmres(const Communicator& comm, std::size_t owned_nodes, std::size_t directions)
    : comm_{comm},
      directions_{directions},
      basis_(directions + 1, Vector(owned_nodes)),
      changes_(directions),
      hessenberg_(directions * (directions + 1)),
      cosines_(directions),
      sines_(directions),
      right_(directions + 1) {}

double Gmres::product(const Vector& a, const Vector& b) const {
  std::vector<double> products(a.size());
  for (std::size_t node = 0; node < a.size(); ++node)
    products[node] =
        a[node][0] * b[node][0] + a[node][1] * b[node][1] + a[node][2] * b[node][2] + a[node][3] * b[node][3];
  return reproducible_sum(comm_, products);
}

double Gmres::norm(const Vector& vector) const { return std::sqrt(product(vector, vector)); }

double Gmres::solve(const Vector& right, double tolerance, const Operator& apply,
                    const Preconditioner& precondition, Vector& solution) {
  for (Flux& entry : solution) entry = {};
  const double size = norm(right);
  if (size == 0) return 0;
  basis_[0] = right;
  scale(1 / size, basis_[0]);
  right_.assign(directions_ + 1, 0.0);
  right_[0] = 1;
  std::size_t step = 0;
  while (step < directions_ && std::abs(right_[step]) > tolerance) {
    precondition(basis_[step], changes_[step]);
    for (std::size_t node = 0; node < solution.size(); ++node) {
      for (std::size_t k = 0; k < 4; ++k) solution[node][k] = changes_[step][node][k];
    }
    apply(solution, basis_[step + 1]);
    orthogonalise(step);
    if (!std::isfinite(entry(step + 1, step))) break;
    rotate(step++);
  }
  combine(step, solution);
  scale(size, solution);
  return std::abs(right_[step]);
}

/// Modified Gram-Schmidt.
void Gmres::orthogonalise(std::size_t step) {
  Vector& next = basis_[step + 1];
  for (std::size_t row = 0; row <= step; ++row) {
    entry(row, step) = product(basis_[row], next);
    add(-entry(row, step), basis_[row], next);
  }
  const double size = entry(step + 1, step) = norm(next);
  if (size > 0) scale(1 / size, next);
}

/// Givens rotations turn the new column's last entry to 0.
void Gmres::rotate(std::size_t step) {
  for (std::size_t row = 0; row < step; ++row) {
    const double upper = entry(row, step), lower = entry(row + 1, step);
    entry(row, step) = cosines_[row] * upper + sines_[row] * lower;
    entry(row + 1, step) = cosines_[row] * lower - sines_[row] * upper;
  }
  const double upper = entry(step, step), lower = entry(step + 1, step), size = std::hypot(upper, lower);
  cosines_[step] = size > 0 ? upper / size : 1;
  sines_[step] = size > 0 ? lower / size : 0;
  entry(step, step) = size;
  right_[step + 1] = -sines_[step] * right_[step];
  right_[step] *= cosines_[step];
}

/// The changes with the weights that solve the triangular system.
void Gmres::combine(std::size_t steps, Vector& solution) const {
  std::vector<double> weights(right_.begin(), right_.begin() + static_cast<std::ptrdiff_t>(steps));
  for (std::size_t column = steps; column-- > 0;) {
    weights[column] = entry(column, column) > 0 ? weights[column] / entry(column, column) : 0;
    for (std::size_t row = 0; row < column; ++row) weights[row] -= entry(row, column) * weights[column];
  }
  for (Flux& value : solution) value = {};
  for (std::size_t column = 0; column < steps; ++column) add(weights[column], changes_[column], solution);
}

}  // namespace quadloop::euler
