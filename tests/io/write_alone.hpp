#pragma once

#include <optional>
#include <string>
#include <variant>

#include "io/files/output_file.hpp"
#include "io/mesh_file.hpp"

namespace quadloop::test {

/// The mesh, which one rank holds whole, as the only output of a set.
inline void write_alone(const Communicator& alone, const io::FileMesh& mesh, const std::string& path,
                        const std::string& format = {}) {
  io::OutputSet outputs(alone);
  io::write_mesh(outputs, mesh, path, format);
  outputs.commit();
}

/// A distributed mesh as the only output of a set, in the format of the suffix. *Collective.*
inline void write_alone(const Communicator& comm, const Mesh& mesh, const std::string& path,
                        const Field* solution = nullptr) {
  io::OutputSet outputs(comm);
  io::write_mesh(outputs, mesh, path, solution);
  outputs.commit();
}

/// The 3D mesh of a file; none where it holds a plane one.
inline std::optional<io::FileMesh> read_mesh3d(const std::string& path) {
  io::MeshOfFile mesh = io::read_mesh_file(path);
  if (std::holds_alternative<io::LoadedMesh>(mesh)) return {};
  return std::get<io::FileMesh>(std::move(mesh));
}

}  // namespace quadloop::test
