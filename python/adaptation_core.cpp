#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>

#include "python/arrays.hpp"
#include "python/core.hpp"
#include "quadloop/quadloop.hpp"

namespace quadloop::python {

namespace {

/// The adaptive loop of a case.
class CoreAdaptation {
 public:
  CoreAdaptation(const CoreCase& of, const std::string& folder, bool resume, bool solver_of_case,
                 const py::object& progress)
      : case_{of}, reports_{progress} {
    const AdaptationOptions options{folder, resume,
                                    solver_of_case ? Solving::by_solver_of_case : Solving::by_caller,
                                    reports_.callback()};
    const py::gil_scoped_release released;
    run_ = std::make_unique<Adaptation>(*case_.comm, *case_.of, options);
  }

  bool begin_cycle() {
    return reports_.watch([&] { return run().begin_cycle(); });
  }
  int cycle() const { return run().cycle(); }
  CoreMesh mesh() const { return core_mesh(case_.comm, run().solved(), run().layers(), *case_.of); }
  py::tuple initial_state() const { return python_field(run().initial_state()); }
  py::tuple solution() const { return python_field(run().solved()->solution); }
  py::tuple finish_cycle(const py::tuple& values) {
    SolvedFlow flow;
    flow.solution = field_on_all_ranks(mesh(), values);
    return finished([&] { return run().finish_cycle(std::move(flow)); });
  }
  /// With the solver of the case.
  py::tuple solve_cycle() {
    return finished([&] { return run().finish_cycle(run().solve()); });
  }
  /// Releases the folder; removes the files of an unfinished cycle.
  void close() { run_.reset(); }

 private:
  Adaptation& run() const {
    if (!run_) throw InputError("the adaptive loop has ended");
    return *run_;
  }
  template <class Finish>
  py::tuple finished(const Finish& finish) {
    const CycleReport report = reports_.watch(finish);
    return py::make_tuple(report.record, report.warnings);
  }

  CoreCase case_;
  StageReports reports_;
  std::unique_ptr<Adaptation> run_;
};

}  // namespace

void add_adaptation(py::module_& module) {
  py::class_<CoreAdaptation>(module, "Adaptation")
      .def(py::init<const CoreCase&, const std::string&, bool, bool, const py::object&>())
      .def("begin_cycle", &CoreAdaptation::begin_cycle)
      .def_property_readonly("cycle", &CoreAdaptation::cycle)
      .def("mesh", &CoreAdaptation::mesh)
      .def("initial_state", &CoreAdaptation::initial_state)
      .def("solution", &CoreAdaptation::solution)
      .def("finish_cycle", &CoreAdaptation::finish_cycle)
      .def("solve_cycle", &CoreAdaptation::solve_cycle)
      .def("close", &CoreAdaptation::close);
}

}  // namespace quadloop::python
