#pragma once

#include <string>

#include "io/model/mesh_of_file.hpp"

namespace quadloop::test {

/// The plane mesh of a file, by the reader of its format.
template <MeshOfFile (*read)(const std::string&)>
LoadedMesh read_plane(const std::string& path) {
  return plane_of(read(path), path);
}

}  // namespace quadloop::test
