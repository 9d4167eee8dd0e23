#pragma once

#include <array>
#include <functional>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::euler {

/// Four values for each owned node, and for others that do not count.
using NodeRows = std::vector<std::array<double, 4>>;

/// A linear system over all ranks, and something near its inverse, which need not be linear.
struct KrylovSystem {
  std::function<void(NodeRows& x, NodeRows& product)> multiply;
  std::function<void(const NodeRows& right, NodeRows& x)> precondition;
  std::size_t owned = 0;
};

struct KrylovEnd {
  int iterations = 0;
  double residual = 0;  ///< of the right side's norm
};

/// Flexible GMRES, begun anew after every `restart` steps, from x = 0: until what is left is below
/// `tolerance` of the right side, or so many iterations are done. Products of vectors are sums that do not
/// depend on the number of ranks. *Collective.*
KrylovEnd solve_by_gmres(const Communicator& comm, const KrylovSystem& system, const NodeRows& right,
                         NodeRows& x, double tolerance, int iterations, int restart);

}  // namespace quadloop::euler
