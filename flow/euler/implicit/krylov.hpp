#pragma once

#include <array>
#include <functional>

#include "mesher/base/id_vector.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::flow::euler {

/// Four values for each owned node; further rows are ignored.
using NodeRows = IdVector<NodeId, std::array<double, 4>>;

/// A linear system over all ranks with a preconditioner, which need not be linear.
struct KrylovSystem {
  std::function<void(NodeRows& x, NodeRows& product)> multiply;
  std::function<void(const NodeRows& right, NodeRows& x)> precondition;
  std::int32_t owned = 0;
};

struct KrylovEnd {
  int iterations = 0;
  double residual = 0;  ///< relative to the norm of the right side
};

/// Flexible GMRES, restarted after every `restart` steps, from x = 0, until the residual is below `tolerance`
/// times the right side or `iterations` are done. Scalar products are independent of the number of ranks.
/// *Collective.*
KrylovEnd solve_by_gmres(const Communicator& comm, const KrylovSystem& system, const NodeRows& right,
                         NodeRows& x, double tolerance, int iterations, int restart);

}  // namespace quadloop::flow::euler
