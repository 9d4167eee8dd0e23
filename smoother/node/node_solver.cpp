#include "smoother/node/node_solver.hpp"

#include "smoother/node/nlopt_solver.hpp"
#include "smoother/node/perturbation.hpp"

namespace quadloop {

std::unique_ptr<NodeSolver> make_node_solver(Method method) {
  if (method == Method::nlopt) return std::make_unique<NloptSolver>();
  return std::make_unique<Perturbation>();
}

}  // namespace quadloop
