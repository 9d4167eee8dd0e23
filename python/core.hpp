#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>

#include "python/arrays.hpp"
#include "quadloop/quadloop.hpp"

/// What the files of the module quadloop._core share.
namespace quadloop::python {

using Released = py::call_guard<py::gil_scoped_release>;

/// A case on a communicator.
struct CoreCase {
  std::shared_ptr<const Communicator> comm;
  std::optional<Case> of;
};

/// A mesh that Python may hold as long as it likes. Its arrays are views.
struct CoreMesh {
  std::shared_ptr<const Communicator> comm;
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const SolvedMesh> solved;  ///< with its tree; null for a mesh from a file
  LayerReport layers;
  std::optional<Case> of;
};

CoreMesh core_mesh(const std::shared_ptr<const Communicator>& comm, std::shared_ptr<const SolvedMesh> solved,
                   LayerReport layers, const Case& of);

/// A field of a mesh from that of Python on each rank. Throws an error of one rank on all ranks.
/// *Collective.*
Field field_on_all_ranks(const CoreMesh& mesh, const py::tuple& given);

/// Adds the class Adaptation to the module.
void add_adaptation(py::module_& module);

/// Adds the built-in flow solver to the module.
void add_flow(py::module_& module);

}  // namespace quadloop::python
