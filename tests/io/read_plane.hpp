#pragma once

#include <string>

#include "io/model/mesh_of_file.hpp"

namespace quadloop::test {

/// The plane mesh of a file, by the reader of its format.
template <io::MeshOfFile (*read)(const std::string&)>
io::LoadedMesh read_plane(const std::string& path) {
  return io::plane_of(read(path), path);
}

}  // namespace quadloop::test
