// The built-in flow solver for the module quadloop._core.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "python/arrays.hpp"
#include "python/core.hpp"
#include "quadloop/quadloop.hpp"

namespace quadloop::python {

namespace {

py::dict functionals_of(const SolvedFlow& flow) {
  py::dict functionals;
  for (const GoalValue& goal : flow.goals) {
    py::dict entry;
    entry["value"] = goal.value;
    entry["corrected"] = goal.corrected;
    entry["error"] = goal.error;
    entry["by_alpha"] = goal.by_alpha;
    entry["by_mach"] = goal.by_mach;
    entry["converged"] = goal.converged;
    functionals[py::str(goal.name)] = entry;
  }
  return functionals;
}

/// The solution as tables, the results as a dictionary. *Collective.*
py::tuple solve(const CoreCase& of, const CoreMesh& mesh, const py::tuple& start) {
  const Field state = field_of(*mesh.mesh, python_field_from(start));
  StageReports signals{py::none()};
  const ProgressCallback check = signals.callback();
  const SolvedFlow flow = signals.watch([&] {
    const progress::Observed observed(
        *mesh.comm, [&](const std::string& stage, double share) { check({.stage = stage, .share = share}); });
    return built_in_solver(*mesh.comm, *of.of)(*mesh.comm, *mesh.mesh, state, -1);
  });
  py::dict results, forces;
  for (const BoundaryForce& force : flow.forces)
    forces[py::str(force.boundary)] = py::make_tuple(force.cl, force.cd);
  results["cl"] = flow.cl;
  results["cd"] = flow.cd;
  results["residual"] = flow.residual;
  results["steps"] = flow.steps;
  results["forces"] = forces;
  results["functionals"] = functionals_of(flow);
  results["warnings"] = flow.warnings;
  return py::make_tuple(python_field(flow.solution), results);
}

}  // namespace

void add_flow(py::module_& module) { module.def("solve", &solve); }

}  // namespace quadloop::python
