// The Python module quadloop._core: the library of quadloop/quadloop.hpp for the package in this folder,
// which adds names, defaults and conversions. Collective calls are those of the library.
#include "python/core.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "python/arrays.hpp"
#include "quadloop/case/case_keys.hpp"
#include "quadloop/quadloop.hpp"

namespace quadloop::python {

CoreMesh core_mesh(const std::shared_ptr<const Communicator>& comm, std::shared_ptr<const SolvedMesh> solved,
                   LayerReport layers, const Case& of) {
  std::shared_ptr<const Mesh> mesh(solved, &solved->mesh);
  return {comm, std::move(mesh), std::move(solved), std::move(layers), of};
}

bool StageReports::report(const Progress& progress) {
  return call([&] {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (function_.is_none()) return true;
    const py::object cycle = progress.cycle < 0 ? py::object(py::none()) : py::int_(progress.cycle);
    return !function_(progress.stage, progress.share, cycle).is(py::bool_(false));
  });
}

namespace {

py::array points_of(const py::object& self) {
  const Mesh& mesh = *self.cast<const CoreMesh&>().mesh;
  static_assert(sizeof(Point) == 2 * sizeof(double));
  return view<double>(mesh.points.data(), {static_cast<py::ssize_t>(mesh.points.size()), 2}, self);
}

py::dict edges_of(const py::object& self) {
  py::dict edges;
  for (const BoundaryEdges& boundary : self.cast<const CoreMesh&>().mesh->boundaries)
    edges[py::str(boundary.name)] = rows_view(boundary.edges, 2, self);
  return edges;
}

py::dict conditions_of(const CoreMesh& self) {
  py::dict conditions;
  for (const BoundaryEdges& boundary : self.mesh->boundaries)
    conditions[py::str(boundary.name)] = boundary.condition.word();
  return conditions;
}

py::array_t<std::int64_t> global_ids(const CoreMesh& self) {
  const Mesh& mesh = *self.mesh;
  py::array_t<std::int64_t> ids(static_cast<py::ssize_t>(mesh.points.size()));
  auto into = ids.mutable_unchecked<1>();
  for (std::int32_t n = 0; n < size32(mesh.points); ++n) into(n) = mesh.global(NodeId{n}).value();
  return ids;
}

py::array_t<std::int64_t> cell_ids(const CoreMesh& self) {
  std::optional<CellOwners> owners;
  {
    const py::gil_scoped_release released;
    owners.emplace(*self.comm, *self.mesh);
  }
  py::array_t<std::int64_t> ids(static_cast<py::ssize_t>(self.mesh->cell_count()));
  for (py::ssize_t i = 0; i < ids.size(); ++i) ids.mutable_data()[i] = owners->number(i);
  return ids;
}

py::dict blocks_of(const py::object& self) {
  const Mesh& mesh = *self.cast<const CoreMesh&>().mesh;
  py::dict blocks;
  blocks["names"] = mesh.blocks.names;
  const auto numbers = [&](const std::vector<std::int32_t>& of_cells) {
    return view<std::int32_t>(of_cells.data(), {static_cast<py::ssize_t>(of_cells.size())}, self);
  };
  blocks["triangles"] = numbers(mesh.blocks.of_triangles);
  blocks["quads"] = numbers(mesh.blocks.of_quads);
  return blocks;
}

py::dict named_nodes_of(const CoreMesh& self) {
  py::dict nodes;
  for (const NamedNode& named : self.mesh->named_nodes) nodes[py::str(named.name)] = named.node.value();
  return nodes;
}

py::list layers_of(const CoreMesh& self) {
  py::list rows;
  for (const BoundaryLayerReport& row : self.layers) {
    py::dict entry;
    entry["boundary"] = row.boundary;
    entry["count"] = row.asked;
    entry["count_reached"] = row.reached;
    entry["columns"] = row.columns;
    entry["y_plus"] = row.y_plus;
    entry["first"] = row.first_least;
    entry["growth"] = row.growth_least;
    entry["thickness"] = row.thickness_asked;
    entry["smallest_share"] = row.share_least;
    entry["coverage"] = row.share_full;
    entry["thinnest_at"] = py::make_tuple(row.least.x, row.least.y);
    rows.append(entry);
  }
  return rows;
}

py::dict quality_of_mesh(const CoreMesh& self) {
  QualitySummary quality;
  {
    const py::gil_scoped_release released;
    quality = summarise_quality(*self.comm, *self.mesh);
  }
  py::dict result;
  result["nodes"] = quality.counts.nodes;
  result["triangles"] = quality.counts.triangles;
  result["quads"] = quality.counts.quads;
  result["boundary_edges"] = quality.counts.boundary_edges;
  result["smallest_angle"] = quality.smallest_degrees;
  result["largest_angle"] = quality.largest_degrees;
  result["worst_quality"] = quality.worst;
  result["mean_quality"] = quality.mean;
  return result;
}

/// A picture of the whole mesh on the root, no bytes on other ranks. *Collective.*
py::bytes picture_of(const CoreMesh& self, const std::string& format, const std::string& field,
                     const py::tuple& values, double size) {
  Field solution = field_of(*self.mesh, python_field_from(values));
  std::string bytes;
  {
    const py::gil_scoped_release released;
    PlotOptions options;
    options.field = field;
    options.size = size;
    bytes = picture(*self.comm, *self.mesh, std::move(solution), options,
                    io::plot_format_of("picture." + format));
  }
  return py::bytes(bytes);
}

void plot_mesh(const CoreMesh& self, const std::string& path, const std::string& field,
               const py::tuple& values, double size) {
  Field solution = field_of(*self.mesh, python_field_from(values));
  const py::gil_scoped_release released;
  PlotOptions options;
  options.field = field;
  options.size = size;
  plot(*self.comm, *self.mesh, path, std::move(solution), options);
}

std::vector<std::string> extrude_mesh(const CoreMesh& self, const std::vector<double>& heights,
                                      const std::string& path, const py::tuple& values, bool along_y) {
  const Field solution = field_of(*self.mesh, python_field_from(values));
  const py::gil_scoped_release released;
  return extrude(*self.comm, *self.mesh, heights, path, solution,
                 along_y ? ExtrusionAxis::y : ExtrusionAxis::z);
}

/// The whole mesh on the root, an empty one elsewhere. *Collective.*
CoreMesh gathered(const CoreMesh& self) {
  const std::shared_ptr<const Communicator> alone = communicator_of(std::nullopt);
  const py::gil_scoped_release released;
  return {
      alone, std::make_shared<const Mesh>(gather_whole(*self.comm, *self.mesh)), nullptr, self.layers, {}};
}

std::vector<std::string> write_mesh(const CoreMesh& self, const std::string& path, const py::tuple& values) {
  const Field field = field_of(*self.mesh, python_field_from(values));
  const py::gil_scoped_release released;
  return write(*self.comm, *self.mesh, path, field);
}

py::tuple make_core_mesh(const CoreCase& self, const py::object& progress) {
  StageReports reports(progress);
  std::optional<NewMesh> made;
  reports.watch([&] { made = make_mesh(*self.comm, *self.of, reports.callback()); });
  auto solved = std::make_shared<const SolvedMesh>(std::move(made->solved));
  return py::make_tuple(core_mesh(self.comm, std::move(solved), std::move(made->layers), *self.of),
                        made->warnings);
}

py::tuple read_core_mesh(const std::string& path, std::optional<MPI_Fint> handle) {
  const std::shared_ptr<const Communicator> comm = communicator_of(handle);
  std::optional<MeshFile> file;
  {
    const py::gil_scoped_release released;
    file = read(*comm, path);
  }
  CoreMesh mesh{comm, std::make_shared<const Mesh>(std::move(file->mesh)), nullptr, {}, {}};
  return py::make_tuple(std::move(mesh), python_field(file->field), file->warnings);
}

/// A mesh of this process from arrays; edges have the domain to their left.
CoreMesh mesh_from_arrays(const DoubleArray& points, const IntArray& triangles, const IntArray& quads,
                          const std::vector<std::pair<std::string, IntArray>>& edges) {
  auto mesh = std::make_shared<Mesh>();
  mesh->points = points_from(points);
  mesh->owned_nodes = size32(mesh->points);
  mesh->triangles = rows_from<3>(triangles, mesh->owned_nodes, "triangles");
  mesh->quads = rows_from<4>(quads, mesh->owned_nodes, "quads");
  for (const auto& [name, rows] : edges)
    mesh->boundaries.push_back({name, {}, rows_from<2>(rows, mesh->owned_nodes, name.c_str())});
  return {communicator_of(std::nullopt), std::move(mesh), nullptr, {}, {}};
}

/// A smoothed copy of a mesh of a case. *Collective.*
CoreMesh smoothed_mesh(const CoreCase& of, const CoreMesh& given, const py::object& progress) {
  StageReports reports(progress);
  auto mesh = std::make_shared<Mesh>(*given.mesh);
  reports.watch([&] { smooth(*of.comm, *of.of, *mesh, reports.callback()); });
  return {given.comm, std::move(mesh), nullptr, given.layers, of.of};
}

/// Boundary, points, and whether the line is open.
using PythonLines = std::vector<std::tuple<std::string, DoubleArray, bool>>;

MorphGeometry geometry_from(const PythonLines& given) {
  std::vector<GeometryLine> lines;
  for (const auto& [boundary, points, open] : given) lines.push_back({boundary, points_from(points), open});
  return MorphGeometry(std::move(lines));
}

/// A mesh moved to another geometry.
class CoreMorph {
 public:
  CoreMorph(const CoreMesh& mesh, const PythonLines& from, const PythonLines& to, double least_quality)
      : before_{mesh} {
    const MorphGeometry old_outline = geometry_from(from), new_outline = geometry_from(to);
    const py::gil_scoped_release released;
    morph_ = std::make_unique<Morph>(*before_.comm, *before_.mesh, old_outline, new_outline, least_quality);
  }

  CoreMesh mesh() const { return {before_.comm, morph_->mesh(), nullptr, before_.layers, before_.of}; }
  double worst_quality() const { return morph_->report().worst_after; }
  bool smoothed() const { return morph_->report().smoothed; }
  DoubleArray push_forward(const std::vector<DoubleArray>& of_points) const {
    std::vector<std::vector<Point>> lists;
    for (const DoubleArray& list : of_points) lists.push_back(points_from(list));
    std::vector<Point> of_nodes;
    {
      const py::gil_scoped_release released;
      of_nodes = morph_->push_forward(lists);
    }
    return array_of(of_nodes);
  }
  std::vector<DoubleArray> pull_back(const DoubleArray& of_nodes) const {
    const std::vector<Point> gradient = points_from(of_nodes);
    std::vector<std::vector<Point>> lists;
    {
      const py::gil_scoped_release released;
      lists = morph_->pull_back(gradient);
    }
    std::vector<DoubleArray> arrays;
    for (const std::vector<Point>& list : lists) arrays.push_back(array_of(list));
    return arrays;
  }

 private:
  CoreMesh before_;
  std::unique_ptr<Morph> morph_;
};

/// Log lines go to a function of Python, with their level. An error of the function does not reach the
/// library.
void log_to(const py::object& function) {
  log::send_to([function](log::Level level, const std::string& line) {
    const py::gil_scoped_acquire acquired;
    try {
      function(static_cast<int>(level), line);
    } catch (py::error_already_set& error) {
      if (error.matches(PyExc_KeyboardInterrupt))
        PyErr_SetInterrupt();  // takes effect at the next stage
      else
        error.discard_as_unraisable("quadloop log");
    }
  });
}

/// Every key of a case, by table.
py::dict keys() {
  py::dict tables;
  for (const TableText& table : case_tables()) {
    py::dict rows;
    for (const KeyText& key : table.keys)
      rows[py::str(key.name)] = py::make_tuple(key.value, key.initial, key.meaning);
    tables[py::str(table.name)] = rows;
  }
  return tables;
}

void add_errors(py::module_& module) {
  static py::exception<InputError> input(module, "InputError", PyExc_ValueError);
  static py::exception<SolverError> solver(module, "SolverError", PyExc_RuntimeError);
  static py::exception<TooFar> too_far(module, "TooFar", input.ptr());
  static py::exception<OutputError> output(module, "OutputError", PyExc_OSError);
  static py::exception<Cancelled> cancelled(module, "Cancelled", PyExc_Exception);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const TooFar& error) {
      py::object raised = py::reinterpret_borrow<py::object>(too_far.ptr())(error.what());
      raised.attr("share") = error.share;
      PyErr_SetObject(too_far.ptr(), raised.ptr());
    } catch (const InputError& error) {
      input(error.what());
    } catch (const SolverError& error) {
      solver(error.what());
    } catch (const OutputError& error) {
      output(error.what());
    } catch (const Cancelled& error) {
      cancelled(error.what());
    }
  });
}

void add_mesh(py::module_& module) {
  py::class_<CoreMesh>(module, "Mesh")
      .def_property_readonly("points", &points_of)
      .def_property_readonly("triangles",
                             [](const py::object& self) {
                               return rows_view(self.cast<const CoreMesh&>().mesh->triangles, 3, self);
                             })
      .def_property_readonly(
          "quads",
          [](const py::object& self) { return rows_view(self.cast<const CoreMesh&>().mesh->quads, 4, self); })
      .def_property_readonly("edges", &edges_of)
      .def_property_readonly("conditions", &conditions_of)
      .def_property_readonly("blocks", &blocks_of)
      .def_property_readonly("named_nodes", &named_nodes_of)
      .def_property_readonly("global_ids", &global_ids)
      .def("cell_ids", &cell_ids)
      .def_property_readonly("owned", [](const CoreMesh& self) { return self.mesh->owned_nodes; })
      .def_property_readonly("comm", [](const CoreMesh& self) { return CoreCommunicator{self.comm}; })
      .def("layers", &layers_of)
      .def("quality", &quality_of_mesh)
      .def(
          "check", [](const CoreMesh& self) { return check(*self.comm, *self.mesh); }, Released())
      .def("picture", &picture_of)
      .def("plot", &plot_mesh)
      .def("extrude", &extrude_mesh)
      .def("gathered", &gathered)
      .def("write", &write_mesh);
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  add_errors(module);
  add_communicator(module);
  add_mesh(module);
  py::class_<CoreCase>(module, "Case")
      .def(py::init([](const std::string& name, const std::optional<std::string>& text,
                       const std::vector<std::string>& assignments, std::optional<MPI_Fint> handle) {
        CoreCase made{communicator_of(handle), {}};
        const py::gil_scoped_release released;
        made.of.emplace(*made.comm, text ? CaseSource(name, *text) : CaseSource(name), assignments);
        return made;
      }))
      .def_property_readonly("title", [](const CoreCase& self) { return self.of->title(); })
      .def_property_readonly("cycles", [](const CoreCase& self) { return self.of->cycles(); })
      .def_property_readonly("warnings", [](const CoreCase& self) { return self.of->warnings(); })
      .def("mesh", &make_core_mesh)
      .def("smoothed", &smoothed_mesh);
  add_adaptation(module);
  py::class_<CoreMorph>(module, "Morph")
      .def(py::init<const CoreMesh&, const PythonLines&, const PythonLines&, double>())
      .def("mesh", &CoreMorph::mesh)
      .def_property_readonly("worst_quality", &CoreMorph::worst_quality)
      .def_property_readonly("smoothed", &CoreMorph::smoothed)
      .def("push_forward", &CoreMorph::push_forward)
      .def("pull_back", &CoreMorph::pull_back);
  module.def("mesh_from_arrays", &mesh_from_arrays);
  module.def("read", &read_core_mesh);
  add_flow(module);
  module.def("keys", &keys);
  module.def("log_to", &log_to);
  module.def("finish", [] {
    log::send_to({});
    finish_communicators();
  });
}

}  // namespace quadloop::python
