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
  CoreAdaptation(const CoreCase& of, const std::string& folder, bool resume) : case_{of} {
    const py::gil_scoped_release released;
    run_ = std::make_unique<Adaptation>(*case_.comm, *case_.of, folder, resume);
  }

  bool begin_cycle() {
    const py::gil_scoped_release released;
    return run_->begin_cycle();
  }
  int cycle() const { return run_->cycle(); }
  CoreMesh mesh() const { return core_mesh(case_.comm, run_->solved(), run_->layers(), *case_.of); }
  py::tuple initial_state() const { return python_field(run_->initial_state()); }
  py::tuple solution() const { return python_field(run_->solved()->solution); }
  py::tuple finish_cycle(const py::tuple& values) {
    SolvedFlow flow;
    flow.solution = field_on_all_ranks(mesh(), values);
    CycleReport report;
    {
      const py::gil_scoped_release released;
      report = run_->finish_cycle(std::move(flow));
    }
    return py::make_tuple(report.record, report.warnings);
  }

 private:
  CoreCase case_;
  std::unique_ptr<Adaptation> run_;
};

}  // namespace

void add_adaptation(py::module_& module) {
  py::class_<CoreAdaptation>(module, "Adaptation")
      .def(py::init<const CoreCase&, const std::string&, bool>())
      .def("begin_cycle", &CoreAdaptation::begin_cycle)
      .def_property_readonly("cycle", &CoreAdaptation::cycle)
      .def("mesh", &CoreAdaptation::mesh)
      .def("initial_state", &CoreAdaptation::initial_state)
      .def("solution", &CoreAdaptation::solution)
      .def("finish_cycle", &CoreAdaptation::finish_cycle);
}

}  // namespace quadloop::python
