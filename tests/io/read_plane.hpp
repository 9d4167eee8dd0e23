#pragma once

#include <mpi.h>

#include <string>

#include "io/model/mesh_of_file.hpp"

namespace quadloop::test {

/// The plane mesh of a file, by the reader of its format.
template <io::MeshOfFile (*read)(const std::string&)>
io::LoadedMesh read_plane(const std::string& path) {
  return io::plane_of(read(path), path);
}

/// The same by a reader for all ranks, on this one alone.
template <io::MeshOfFile (*read)(const Communicator&, const std::string&)>
io::LoadedMesh read_plane(const std::string& path) {
  return io::plane_of(read(Communicator(MPI_COMM_SELF), path), path);
}

}  // namespace quadloop::test
