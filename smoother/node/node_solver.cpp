#include "smoother/node/node_solver.hpp"

#include "mesher/base/error.hpp"
#include "smoother/node/newton.hpp"
#include "smoother/node/nlopt_solver.hpp"

namespace quadloop::smoother {

std::unique_ptr<NodeSolver> make_node_solver(Method method) {
  switch (method) {
    case Method::perturb: return std::make_unique<Newton>();
    case Method::nlopt: return std::make_unique<NloptSolver>();
  }
  QUADLOOP_REQUIRE(false, "a method without a solver");
  return nullptr;
}

}  // namespace quadloop::smoother
