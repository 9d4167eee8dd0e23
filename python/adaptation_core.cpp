#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "python/arrays.hpp"
#include "python/core.hpp"
#include "quadloop/quadloop.hpp"

namespace quadloop::python {

namespace {

template <class Number, std::size_t width>
py::array_t<Number> table_of_rows(const std::vector<std::array<GlobalNodeId, width>>& rows) {
  py::array_t<Number> table({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(width)});
  for (std::size_t i = 0; i < rows.size() * width; ++i)
    table.mutable_data()[i] = rows[i / width][i % width].value();
  return table;
}

/// For two meshes on the same communicator. *Collective.*
CoreMap map_between(const CoreMesh& old_mesh, const CoreMesh& new_mesh) {
  const py::gil_scoped_release released;
  return {old_mesh.comm, std::make_shared<const TransferMap>(*old_mesh.comm, *old_mesh.mesh, *new_mesh.mesh)};
}

/// Rows of the map, or their weighted sums, from a table of values at the owned nodes of the old mesh.
/// *Collective.*
DoubleArray mapped(const CoreMap& self, const DoubleArray& values, bool sums) {
  const auto width = static_cast<std::size_t>(values.shape(1));
  std::vector<double> of_old(values.data(), values.data() + values.size());
  std::vector<double> rows;
  {
    const py::gil_scoped_release released;
    rows = sums ? self.map->interpolate(of_old, width) : self.map->rows(of_old, width);
  }
  return table_of(rows, width);
}

void add_map(py::module_& module) {
  py::class_<CoreMap>(module, "TransferMap")
      .def(py::init(&map_between))
      .def_property_readonly(
          "nodes", [](const CoreMap& self) { return table_of_rows<std::int64_t>(self.map->nodes()); })
      .def_property_readonly(
          "weights",
          [](const py::object& self) {
            const auto& rows = self.cast<const CoreMap&>().map->weights();
            return view<double>(rows.data(), {static_cast<py::ssize_t>(rows.size()), 3}, self);
          })
      .def_property_readonly("same",
                             [](const py::object& self) {
                               const auto& ids = self.cast<const CoreMap&>().map->same();
                               static_assert(sizeof(GlobalNodeId) == sizeof(std::int64_t));
                               return view<std::int64_t>(ids.data(), {static_cast<py::ssize_t>(ids.size())},
                                                         self);
                             })
      .def_property_readonly("same_cells",
                             [](const py::object& self) {
                               const auto& ids = self.cast<const CoreMap&>().map->same_cells();
                               return view<std::int64_t>(ids.data(), {static_cast<py::ssize_t>(ids.size())},
                                                         self);
                             })
      .def("rows", [](const CoreMap& self, const DoubleArray& values) { return mapped(self, values, false); })
      .def("interpolate",
           [](const CoreMap& self, const DoubleArray& values) { return mapped(self, values, true); });
}

/// The adaptive loop of a case.
class CoreAdaptation {
 public:
  CoreAdaptation(const CoreCase& of, const std::string& folder, bool resume, bool solver_of_case,
                 const py::object& progress, const py::object& transfer)
      : case_{of}, reports_{progress}, transfer_{transfer} {
    const AdaptationOptions options{folder, resume,
                                    solver_of_case ? Solving::by_solver_of_case : Solving::by_caller,
                                    reports_.callback(), transfer_by()};
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
    flow.solution = field_of(run().solved()->mesh, python_field_from(values));
    return finished([&] { return run().finish_cycle(std::move(flow)); });
  }
  /// With the solver of the case.
  py::tuple solve_cycle() {
    return finished([&] { return run().finish_cycle(run().solve()); });
  }
  /// Releases the folder; removes the files of an unfinished cycle.
  void close() { run_.reset(); }

 private:
  /// A transfer by a function of Python, which gets the old mesh, its solution and the new mesh.
  TransferFunction transfer_by() {
    if (transfer_.is_none()) return {};
    return [this](const Mesh& /*old_mesh*/, const Field& old, const Mesh& new_mesh) {
      return reports_.call([&] {
        const CoreMesh before = mesh();
        CoreMesh after{case_.comm, std::make_shared<const Mesh>(new_mesh), nullptr, {}, case_.of};
        const py::tuple rows = transfer_(before, python_field(old), after);
        return field_of(*after.mesh, python_field_from(rows));
      });
    };
  }
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
  py::object transfer_;
  std::unique_ptr<Adaptation> run_;
};

}  // namespace

void add_adaptation(py::module_& module) {
  add_map(module);
  py::class_<CoreAdaptation>(module, "Adaptation")
      .def(py::init<const CoreCase&, const std::string&, bool, bool, const py::object&, const py::object&>())
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
