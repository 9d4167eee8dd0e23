#pragma once

#include <functional>
#include <vector>

#include "flow/euler/implicit/implicit_system.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::euler {

/// Solves A x = b by flexible GMRES without restarts (Saad 1993): the preconditioner need be no fixed matrix.
/// Vectors have an entry for each owned node. Inner products are reproducible_sum, so that the result has the
/// same bits on any number of ranks.
class Gmres {
 public:
  using Vector = std::vector<Flux>;
  using Operator = std::function<void(const Vector&, Vector&)>;
  /// A change for each node, copies too, that nearly solves A change = vector.
  using Preconditioner = std::function<void(const Vector&, std::vector<Change>&)>;

  /// `comm` must outlive it. At most so many directions are tried.
  Gmres(const Communicator& comm, std::size_t owned_nodes, std::size_t directions);

  /// Ends once the residual has fallen to that share of the right side. Returns the share that it fell to.
  /// *Collective.*
  double solve(const Vector& right, double tolerance, const Operator& apply,
               const Preconditioner& precondition, Vector& solution);

  /// Of a vector, over all ranks. *Collective.*
  double norm(const Vector& vector) const;

 private:
  double product(const Vector& a, const Vector& b) const;
  void orthogonalise(std::size_t step);
  void rotate(std::size_t step);
  void combine(std::size_t steps, Vector& solution) const;
  double& entry(std::size_t row, std::size_t column) { return hessenberg_[column * (directions_ + 1) + row]; }
  double entry(std::size_t row, std::size_t column) const {
    return hessenberg_[column * (directions_ + 1) + row];
  }

  const Communicator& comm_;
  std::size_t directions_;
  std::vector<Vector> basis_;                    ///< orthonormal
  std::vector<std::vector<Change>> changes_;     ///< what the preconditioner made of them
  std::vector<double> hessenberg_;               ///< column by column, made triangular by the rotations
  std::vector<double> cosines_, sines_, right_;  ///< rotations; the right side that they turn
};

}  // namespace quadloop::euler
